#pragma once
/// \file
/// The profiles that are part of the command: named sets of options, for --profile.

#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "cli/shell/command_tree.hpp"

namespace faqem::cli {

/// A named set of options.
struct BuiltinProfile {
    std::string_view name, purpose;
    /// Names without dashes, and values; a flag of profiles has the value `true`, as in a file.
    std::span<const std::pair<std::string_view, std::string_view>> options;
};

/// All profiles.
std::span<const BuiltinProfile> builtin_profiles();

/// The profile with a name. \throws OptionError  there is none; the message lists all
const BuiltinProfile& builtin_profile(std::string_view name);

/// The option --profile. It has no effect itself: add_profile_values() adds the values of the profile.
OptionInfo builtin_profile_option();

/// The content of a file for --config with the options of a profile.
std::string profile_file(const BuiltinProfile& profile);

/// What all profiles set, for people: the options as on the command line.
std::string profile_list();

}  // namespace faqem::cli
