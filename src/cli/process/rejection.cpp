#include "cli/process/rejection.hpp"

#include <sstream>

#include "asset/scene/messages.hpp"
#include "cli/process/interrupt.hpp"

namespace faqem::cli {

std::string warnings_text(const std::vector<std::string>& warnings) {
    std::string text = detail::pluralized(warnings.size(), "warning") + "\n";
    for (const std::string& warning : warnings) text += "  " + warning + "\n";
    return text;
}

std::optional<CommandError> rejection(const Report& report, bool strict_target,
                                      const std::filesystem::path& in, const std::filesystem::path& out) {
    ExitCode code = exit_bad_input;
    std::ostringstream text;
    if (report.faces_out == 0) {
        text << "nothing is left of " << in.string() << "; ";
    } else if (strict_target && report.faces_out > report.target_faces) {
        code = exit_target_missed;
        text << in.string() << ": target missed: the result has " << report.faces_out
             << " faces, the target is " << report.target_faces << "; ";
    } else if (report.max_error && !report.max_error->within()) {
        code = exit_error_exceeded;
        text << in.string() << ": max error exceeded: the result with " << report.faces_out
             << " faces may have a distance of up to " << report.max_error->bound << ", "
             << report.max_error->allowed << " is allowed; ";
    } else {
        return std::nullopt;
    }
    text << out.string() << " was not written";
    return CommandError(code, text.str());
}

void require_not_cancelled(const Report& report) {
    if (is_interrupted() || report.stop == StopReason::cancelled)
        throw CommandError(exit_cancelled, "cancelled");
}

void require_accepted(const Report& report, bool strict_target, const std::filesystem::path& in,
                      const std::filesystem::path& out) {
    if (const auto rejected = rejection(report, strict_target, in, out)) throw *rejected;
}

}  // namespace faqem::cli
