#pragma once
/// \file
/// Functions that add the subcommands to the command line. Parsing a command line with a subcommand sets
/// `action` to the function that runs it.

#include <functional>

namespace CLI {
class App;
}

namespace faqem::cli {

/// Runs a command. Returns an exit code, or throws an exception that exit_code_of() maps to one.
using Action = std::function<int()>;

void add_simplify_command(CLI::App& app, Action& action);
void add_lod_command(CLI::App& app, Action& action);
void add_truncate_command(CLI::App& app, Action& action);
void add_batch_command(CLI::App& app, Action& action);
void add_info_command(CLI::App& app, Action& action);
void add_compare_command(CLI::App& app, Action& action);
void add_render_command(CLI::App& app, Action& action);
void add_report_command(CLI::App& app, Action& action);
void add_completion_command(CLI::App& app, Action& action);
void add_man_command(CLI::App& app, Action& action);

}  // namespace faqem::cli
