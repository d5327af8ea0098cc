#pragma once
/// \file
/// Commands and options as plain data, from which the manual page, completion scripts and suggestions are
/// made.

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace faqem::cli {

/// An option or a positional argument.
struct OptionInfo {
    std::vector<std::string> names;     ///< for example `-h` and `--help`; one name for an argument
    std::string value_name;             ///< placeholder for the value; empty for flags and arguments
    std::vector<std::string> choices;   ///< the possible values; empty if they are not enumerated
    std::string optional_value_name;    ///< placeholder for the value of a flag that accepts `=VALUE`
    std::vector<std::string> excludes;  ///< options that cannot be given together with this one, sorted
    std::string description;
};

struct CommandInfo {
    std::string name, description;
    std::vector<std::string> examples;  ///< one line each
    std::vector<OptionInfo> arguments, options;
};

struct CommandTree {
    std::string description;
    std::string exit_codes;           ///< paragraph that lists the exit codes
    std::vector<OptionInfo> options;  ///< options of `faqem` without a subcommand
    std::vector<CommandInfo> commands;
};

/// Extracts commands and options. \param app  filled by build_command_line()
CommandTree command_tree(const CLI::App& app);

}  // namespace faqem::cli
