#pragma once
/// \file
/// The complete command line.

#include "cli/shell/command_tree.hpp"

namespace faqem::cli {

/// All commands with their options. Each result has variables of its own for the values.
CommandTree command_tree();

/// Adds --help to each command, and the reading of profiles.
void complete_options(CommandTree& tree);

}  // namespace faqem::cli
