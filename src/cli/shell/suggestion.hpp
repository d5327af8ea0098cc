#pragma once
/// \file
/// Suggestions for misspelt commands and options.

#include <string>
#include <vector>

#include "cli/shell/command_tree.hpp"

namespace faqem::cli {

/// Returns the known command or option that is closest to the first unknown one on a command line.
/// \param words  the command line without the name of the program
/// \return empty if no command or option is unknown or none is close
std::string suggestion(const CommandTree& tree, const std::vector<std::string>& words);

}  // namespace faqem::cli
