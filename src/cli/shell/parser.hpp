#pragma once
/// \file
/// The parser of the command line.

#include "cli/shell/command_tree.hpp"

namespace CLI {
class App;
}

namespace faqem::cli {

/// Adds all commands and options to an empty app. Parsing a command line passes the values to the options
/// (OptionInfo::read) and sets `action` to the function that runs the command.
/// \param tree  must exist until the command line is parsed
void add_to_parser(CLI::App& app, const CommandTree& tree, Action& action);

}  // namespace faqem::cli
