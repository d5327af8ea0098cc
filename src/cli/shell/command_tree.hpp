#pragma once
/// \file
/// The command line as plain data: what man page, completion and suggestions are made from.

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace faqem::cli {

/// An option, or an argument without dashes.
struct OptionInfo {
    std::vector<std::string> names;     ///< `-h` and `--help`; of an argument its one name
    std::string value_name;             ///< what stands for the value; empty: a flag, or an argument
    std::vector<std::string> choices;   ///< all that the value can be; empty: anything
    std::string optional_value_name;    ///< of a flag that may have a value behind `=`: what stands for it
    std::vector<std::string> excludes;  ///< options that cannot be given with it, sorted
    std::string description;
};

struct CommandInfo {
    std::string name, description;
    std::vector<std::string> examples;  ///< one line each
    std::vector<OptionInfo> arguments, options;
};

struct CommandTree {
    std::string description;
    std::string exit_codes;           ///< a paragraph
    std::vector<OptionInfo> options;  ///< of the command itself
    std::vector<CommandInfo> commands;
};

/// \param app  from build_command_line()
CommandTree command_tree(const CLI::App& app);

}  // namespace faqem::cli
