#pragma once
/// \file
/// The commands, each with its options and the function that runs it.

#include "cli/shell/command_tree.hpp"

namespace faqem::cli {

CommandInfo simplify_command();
CommandInfo lod_command();
CommandInfo truncate_command();
CommandInfo bake_command();
CommandInfo batch_command();
CommandInfo list_command();
CommandInfo info_command();
CommandInfo compare_command();
CommandInfo render_command();
CommandInfo report_command();
CommandInfo profiles_command();
CommandInfo completion_command();

}  // namespace faqem::cli
