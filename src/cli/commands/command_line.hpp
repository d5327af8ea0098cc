#pragma once
/// \file
/// The whole command line: all commands, what stands for their values in help, and examples.

#include "cli/commands/commands.hpp"

namespace faqem::cli {

/// Adds everything to an empty app. When a command is chosen, `action` becomes what it does.
void build_command_line(CLI::App& app, Action& action);

}  // namespace faqem::cli
