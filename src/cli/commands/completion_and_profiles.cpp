#include <iostream>
#include <memory>
#include <string>

#include "cli/commands/command_line.hpp"
#include "cli/commands/commands.hpp"
#include "cli/options/bound_options.hpp"
#include "cli/options/profile.hpp"
#include "cli/process/exit_code.hpp"
#include "cli/shell/completion.hpp"

namespace faqem::cli {

CommandInfo completion_command() {
    return {"completion", "Print a completion script for bash", {"source <(faqem completion)"}, {}, {}, [] {
                std::cout << bash_completion(command_tree());
                return exit_ok;
            }};
}

CommandInfo profiles_command() {
    const auto name = std::make_shared<std::string>();
    OptionInfo shown = positional("NAME", *name, "Print this profile as a file for --config",
                                  builtin_profile_option().value_name);
    shown.is_required = false;
    return {"profiles",
            "Show what the built-in profiles set",
            {"faqem profiles", "faqem profiles web > web.json"},
            {shown},
            {},
            [name] {
                std::cout << (name->empty() ? profile_list() : profile_file(*name));
                return exit_ok;
            }};
}

}  // namespace faqem::cli
