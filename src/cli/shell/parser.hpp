#pragma once
/// \file
/// The parser of the command line, and suggestions for misspelt commands and options.

#include <string>
#include <vector>

#include "cli/shell/command_tree.hpp"

namespace CLI {
class App;
}

namespace faqem::cli {

/// Adds all commands and options to an empty app. Parsing a command line passes the values to the options
/// (OptionInfo::read) and sets `action` to the function that runs the command.
/// \param tree  must exist until the command line is parsed
void add_to_parser(CLI::App& app, const CommandTree& tree, Action& action);

/// Returns the known command or option that is closest to the first unknown one on a command line.
/// \param words  the command line without the name of the program
/// \return empty if no command or option is unknown or none is close
std::string suggestion(const CommandTree& tree, const std::vector<std::string>& words);

}  // namespace faqem::cli
