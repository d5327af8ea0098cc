#pragma once
/// \file
/// The subcommands. Each adds itself to the command line; when it is chosen, `action` becomes what it does.

#include <functional>

namespace CLI {
class App;
}

namespace faqem::cli {

/// Returns an exit code, or throws what faqem throws.
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
