#pragma once
/// \file
/// Profiles: JSON files with options, see docs/reference.md, and named sets of options that are part of the command.

#include <string>
#include <vector>

#include "cli/shell/command_tree.hpp"

namespace faqem::cli {

/// The option --config. It has no effect itself: add_profile_values() reads the profile.
OptionInfo profile_option();

/// The option --profile. It has no effect itself: add_profile_values() adds the values of the profile.
OptionInfo builtin_profile_option();

/// The content of a file for --config with the options of a built-in profile.
/// \throws OptionError  there is no profile of this name; the message lists all
std::string profile_file(const std::string& name);

/// What all built-in profiles set, for people: the options as on the command line.
std::string profile_list();

/// Adds the values of the profiles that --config and --profile name. What was typed takes precedence over the file of
/// --config, and both over the built-in profile: entries of a profile are omitted if their option, or one that excludes
/// it, has a value.
/// \param tree    all commands and options
/// \param values  of the command; typed ones, to which the others are added
/// \throws ReadError    the profile cannot be read
/// \throws InputError   the profile is not a JSON object or has duplicate keys
/// \throws OptionError  there is no built-in profile of this name, the version is not supported, a key is not an option
///                      of the command, two entries exclude each other, or a value has the wrong type
void add_profile_values(const CommandTree& tree, const CommandInfo& command,
                        std::vector<ParsedValue>& values);

}  // namespace faqem::cli
