#pragma once
/// \file
/// Profiles: JSON files with options, see docs/reference.md.

#include <string>
#include <vector>

#include "cli/shell/command_tree.hpp"

namespace faqem::cli {

/// The option --config. It has no effect itself: expand_profile() reads the profile before parsing.
OptionInfo profile_option();

/// Returns the command line with the options of its profiles appended; unchanged without --config and --profile. The
/// command line takes precedence over the file of --config, and both over the built-in profile: entries of a profile
/// are omitted if their option, or one that excludes it, is given.
/// \param tree   all commands and options
/// \param words  the command line without the name of the program
/// \throws ReadError    the profile cannot be read
/// \throws InputError   the profile is not a JSON object or has duplicate keys
/// \throws OptionError  there is no built-in profile of this name, the version is not supported, a key is not an option
///                      of the command, or a value has the wrong type
std::vector<std::string> expand_profile(const CommandTree& tree, std::vector<std::string> words);

}  // namespace faqem::cli
