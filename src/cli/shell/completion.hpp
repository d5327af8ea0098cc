#pragma once
/// \file
/// Completion script for bash.

#include <string>

#include "cli/shell/command_tree.hpp"

namespace faqem::cli {

/// Returns a completion script for bash 4 or newer. It does not need the package bash-completion.
std::string bash_completion(const CommandTree& tree);

}  // namespace faqem::cli
