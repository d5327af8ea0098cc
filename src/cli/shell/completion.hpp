#pragma once
/// \file
/// Completion scripts for shells.

#include <string>

#include "cli/shell/command_tree.hpp"

namespace faqem::cli {

/// Returns a completion script for bash 4 or newer. It does not need the package bash-completion.
std::string bash_completion(const CommandTree& tree);

/// Returns a completion script for zsh, which can be installed as function file `_faqem` or sourced.
std::string zsh_completion(const CommandTree& tree);

}  // namespace faqem::cli
