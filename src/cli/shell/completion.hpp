#pragma once
/// \file
/// Scripts that complete the command line in a shell.

#include <string>

#include "cli/shell/command_tree.hpp"

namespace faqem::cli {

/// For bash 4 or newer, without the package bash-completion.
std::string bash_completion(const CommandTree& tree);

/// For zsh, as a function file `_faqem` or to be sourced.
std::string zsh_completion(const CommandTree& tree);

}  // namespace faqem::cli
