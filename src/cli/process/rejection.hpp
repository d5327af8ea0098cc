#pragma once
/// \file
/// Results that must not be written, and the warnings of results, as text.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "cli/process/exit_code.hpp"
#include "faqem/report.hpp"

namespace faqem::cli {

/// `2 warnings`, and a line for each, as the summaries of commands print them.
std::string warnings_text(const std::vector<std::string>& warnings);

/// Returns the error of a result that must not be written, with exit_bad_input (nothing is left), exit_target_missed or
/// exit_error_exceeded; nothing for other results. An empty model is useless to the next program, and usually means that
/// the faces of the input have no area, or that --weld is larger than the model.
/// \param in, out  names of the input and of the file that was not written
std::optional<CommandError> rejection(const Report& report, bool strict_target,
                                      const std::filesystem::path& in, const std::filesystem::path& out);

/// \throws CommandError  exit_cancelled: a signal or the progress callback has ended the run
void require_not_cancelled(const Report& report);

/// \throws CommandError  the result is rejected, see rejection()
void require_accepted(const Report& report, bool strict_target, const std::filesystem::path& in,
                      const std::filesystem::path& out);

}  // namespace faqem::cli
