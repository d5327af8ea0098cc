#pragma once
/// \file
/// What the C door's objects are inside, where it was built with assets or without.

#include <string>

#include "faqem/faqem.h"
#include "faqem/options.hpp"
#include "faqem/report_json.hpp"

struct faqem_options {
    faqem::Options options;
};

namespace faqem::capi {

/// A report and its JSON, made at once: getters only read.
struct ReportWithJson {
    explicit ReportWithJson(const Report& r) : report(r), json(to_json(r)) {}

    Report report;
    std::string json;
};

/// The numbers of a report.
faqem_report to_c_report(const Report& report);

/// The options, or the defaults where there are none.
inline Options options_or_defaults(const faqem_options* options) {
    return options ? options->options : Options{};
}

}  // namespace faqem::capi
