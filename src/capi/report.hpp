#pragma once
/// \file
/// Definition of faqem_options, and conversion of reports.

#include <string>

#include "faqem/faqem.h"
#include "faqem/options.hpp"
#include "faqem/report_json.hpp"

struct faqem_options {
    faqem::Options options;
};

namespace faqem::capi {

/// A report and its JSON, which is made in the constructor, so that getters are thread-safe.
struct ReportWithJson {
    explicit ReportWithJson(const Report& r) : report(r), json(to_json(r)) {}

    Report report;
    std::string json;
};

/// Converts a report to that of the C API.
faqem_report to_c_report(const Report& report);

/// Returns the options, or the defaults if `options` is null.
inline Options options_or_defaults(const faqem_options* options) {
    return options ? options->options : Options{};
}

}  // namespace faqem::capi
