#pragma once
/// \file
/// The text of --help and --help-all.

#include <string>

#include "cli/shell/command_tree.hpp"

namespace faqem::cli {

/// Text of `faqem --help`.
std::string tree_help(const CommandTree& tree);

/// Text of `faqem COMMAND --help`, with the options that have a group, each on one line; with `all` those of
/// --help-all, which has all options and their whole descriptions.
std::string command_help(const CommandInfo& command, bool all);

}  // namespace faqem::cli
