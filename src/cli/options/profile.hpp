#pragma once
/// \file
/// Options kept in a file: docs/profile.md.

#include <string>
#include <vector>

#include "cli/shell/command_tree.hpp"

namespace CLI {
class App;
}

namespace faqem::cli {

/// Adds --config to a command. It is expand_profile() that reads it.
void add_profile_option(CLI::App& command);

/// The command line with the options of its profile behind it; where there is no --config, as it is. What is
/// on the command line beats the profile: an option of the same name, and one that excludes the profile's.
/// \param words  of the command line, without the program's name
/// \throws ReadError    the profile cannot be read
/// \throws InputError   it is no JSON
/// \throws OptionError  it is of another version, or has a key that is no option of the command
std::vector<std::string> expand_profile(const CommandTree& tree, std::vector<std::string> words);

}  // namespace faqem::cli
