#pragma once
/// \file
/// Profiles: JSON files with options, see docs/profile.md.

#include <string>
#include <vector>

#include "cli/shell/command_tree.hpp"

namespace CLI {
class App;
}

namespace faqem::cli {

/// Adds --config to a command. The option itself has no effect: expand_profile() reads the profile before
/// parsing.
void add_profile_option(CLI::App& command);

/// Returns the command line with the options of its profile appended; unchanged if there is no --config. The
/// command line takes precedence: entries of the profile are omitted if their option, or one that excludes
/// it, is given.
/// \param tree   all commands and options
/// \param words  the command line without the name of the program
/// \throws ReadError    the profile cannot be read
/// \throws InputError   the profile is not a JSON object or has duplicate keys
/// \throws OptionError  the version is not supported, a key is not an option of the command, or a value has
/// the wrong type
std::vector<std::string> expand_profile(const CommandTree& tree, std::vector<std::string> words);

}  // namespace faqem::cli
