#pragma once
/// \file
/// Definitions of faqem_options and faqem_result, and conversion of levels and reports.

#include <limits>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "capi/guard.hpp"
#include "faqem/faqem_levels.h"
#include "faqem/levels.hpp"
#include "faqem/options.hpp"
#include "faqem/report_json.hpp"
#include "faqem/simplify.hpp"

struct faqem_options {
    faqem::Options options;
    std::vector<std::string_view> named;  ///< names of options that were set by name
};

namespace faqem::capi {

/// Tests whether a C enumerator and a C++ enumerator have the same value.
template <class CEnum, class CppEnum>
constexpr bool has_same_value(CEnum c_value, CppEnum cpp_value) {
    return static_cast<int>(c_value) == static_cast<int>(cpp_value);
}

/// A report and its JSON, which is made in the constructor, so that getters are thread-safe.
struct ReportWithJson {
    explicit ReportWithJson(const Report& r) : report(r), json(to_json(r)) {}

    Report report;
    std::string json;
};

/// Converts a report to that of the C API.
faqem_report to_c_report(const Report& report);

/// Adds a warning for each option that was set by name and is for assets: arrays ignore it.
void warn_of_asset_options(const faqem_options* options, Report& report);

/// Converts levels of the C API.
/// \throws OptionError  a kind is unknown, or a number of faces is not an integer from 1 to 2^53
std::vector<Level> to_levels(const faqem_level* levels, std::size_t count);

/// Returns the options, or the defaults if `options` is null.
inline Options options_or_defaults(const faqem_options* options) {
    return options ? options->options : Options{};
}

}  // namespace faqem::capi

struct faqem_result {
    /// \throws CancelledError  the run was cancelled
    explicit faqem_result(faqem::SimplifyResult result,
                          double error = std::numeric_limits<double>::quiet_NaN())
        : out(std::move(result)), stored_report(out.report), level_error(error) {
        if (out.report.stop == faqem::StopReason::cancelled) throw faqem::capi::CancelledError();
    }

    faqem::SimplifyResult out;
    faqem::capi::ReportWithJson stored_report;
    double level_error;  ///< NaN if the result is not a level
};
