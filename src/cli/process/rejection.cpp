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

ExitCode rejection_code(const Report& report, bool strict_target) {
    if (report.faces_out == 0) return exit_bad_input;
    if (strict_target && report.faces_out > report.target_faces) return exit_target_missed;
    if (report.max_error && !report.max_error->within()) return exit_error_exceeded;
    return exit_ok;
}

std::string rejection_message(ExitCode rejection, const std::filesystem::path& in,
                              const std::filesystem::path& out, const Report& report) {
    std::ostringstream text;
    if (rejection == exit_bad_input) {
        text << "nothing is left of " << in.string() << "; ";
    } else if (rejection == exit_target_missed) {
        text << in.string() << ": target missed: the result has " << report.faces_out
             << " faces, the target is " << report.target_faces << "; ";
    } else {
        text << in.string() << ": max error exceeded: the result with " << report.faces_out
             << " faces may have a distance of up to " << report.max_error->bound << ", "
             << report.max_error->allowed << " is allowed; ";
    }
    text << out.string() << " was not written";
    return text.str();
}

void require_not_cancelled(const Report& report) {
    if (is_interrupted() || report.stop == StopReason::cancelled)
        throw CommandError(exit_cancelled, "cancelled");
}

void require_accepted(const Report& report, bool strict_target, const std::filesystem::path& in,
                      const std::filesystem::path& out) {
    const ExitCode rejection = rejection_code(report, strict_target);
    if (rejection != exit_ok) throw CommandError(rejection, rejection_message(rejection, in, out, report));
}

}  // namespace faqem::cli
