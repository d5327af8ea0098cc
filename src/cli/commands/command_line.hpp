#pragma once
/// \file
/// The complete command line: all commands, placeholders for option values, and examples.

#include "cli/commands/commands.hpp"

namespace faqem::cli {

/// Adds all commands to an empty app. Parsing a command line sets `action` to the function that runs its
/// command.
void build_command_line(CLI::App& app, Action& action);

}  // namespace faqem::cli
