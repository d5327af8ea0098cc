#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>
#include <string>

#include "cli/commands/commands.hpp"
#include "cli/exit_code.hpp"
#include "cli/shell/command_tree.hpp"
#include "cli/shell/completion.hpp"
#include "cli/shell/man_page.hpp"
#include "faqem/version.hpp"

namespace faqem::cli {

void add_completion_command(CLI::App& app, Action& action) {
    const auto shell = std::make_shared<std::string>();
    CLI::App* command = app.add_subcommand("completion", "Print a completion script for a shell");
    command->add_option("SHELL", *shell, "bash or zsh")->required()->check(CLI::IsMember({"bash", "zsh"}));
    command->final_callback([shell, &app, &action] {
        action = [shell, &app]() -> int {
            const CommandTree tree = command_tree(app);
            std::cout << (*shell == "bash" ? bash_completion(tree) : zsh_completion(tree));
            return exit_ok;
        };
    });
}

void add_man_command(CLI::App& app, Action& action) {
    CLI::App* command = app.add_subcommand("man", "Print the manual page");
    command->final_callback([&app, &action] {
        action = [&app]() -> int {
            std::cout << man_page(command_tree(app), version());
            return exit_ok;
        };
    });
}

}  // namespace faqem::cli
