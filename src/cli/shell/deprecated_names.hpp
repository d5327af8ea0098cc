#pragma once
/// \file
/// Old names of commands, options and values, which are accepted for one minor version.

#include <string>
#include <vector>

namespace faqem::cli {

/// Returns the current name of an option, or the name itself if it is current.
/// \param option  with its dashes, for example `--lock-border`
std::string current_option_name(const std::string& option);

/// Replaces deprecated names by current ones. Words after `--` are not changed.
/// \param words     the command line without the program's name
/// \param warnings  receives one sentence for each replaced name
/// \return the command line with current names
/// O(words)
std::vector<std::string> replace_deprecated_names(std::vector<std::string> words,
                                                  std::vector<std::string>& warnings);

}  // namespace faqem::cli
