#include "capi/c_result.hpp"

#include <algorithm>

#include "faqem/detail/options/appearance_rows.hpp"
#include "faqem/detail/options/option_table.hpp"

namespace faqem::capi {

static_assert(has_same_value(FAQEM_STOP_REACHED_TARGET, StopReason::reached_target) &&
              has_same_value(FAQEM_STOP_NO_LEGAL_COLLAPSE, StopReason::no_legal_collapse) &&
              has_same_value(FAQEM_STOP_REACHED_MAX_ERROR, StopReason::reached_max_error) &&
              has_same_value(FAQEM_STOP_REACHED_TIME_LIMIT, StopReason::reached_time_limit));

faqem_report to_c_report(const Report& report) {
    constexpr double none = std::numeric_limits<double>::quiet_NaN();
    faqem_report numbers = {};
    numbers.vertices_in = report.vertices_in;
    numbers.vertices_out = report.vertices_out;
    numbers.faces_in = report.faces_in;
    numbers.faces_out = report.faces_out;
    numbers.target_faces = report.target_faces;
    numbers.error_value = report.max_error ? report.max_error->value : none;
    numbers.error_bound = report.max_error ? report.max_error->bound : none;
    numbers.seconds = report.seconds.total;
    numbers.stop = static_cast<faqem_stop>(report.stop);
    numbers.within_max_error = !report.max_error || report.max_error->within() ? 1 : 0;
    return numbers;
}

void warn_of_asset_options(const faqem_options* options, Report& report) {
    if (!options) return;
    for (const detail::OptionRow& row : detail::appearance_rows)
        if (std::count(options->named.begin(), options->named.end(), row.name) > 0)
            report.warnings.push_back(detail::member_spelling(row) +
                                      " has no effect: it is for models, not for arrays");
}

}  // namespace faqem::capi
