#pragma once
/// \file
/// Definition of faqem_result.

#include <limits>
#include <utility>

#include "capi/guard.hpp"
#include "capi/report.hpp"
#include "faqem/simplify.hpp"

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
