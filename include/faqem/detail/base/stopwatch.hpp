#pragma once
/// \file
/// Elapsed time of the phases in a report.

#include <chrono>

#include "faqem/export.hpp"

FAQEM_DETAIL_BEGIN

/// Measures the wall-clock time since its construction.
class Stopwatch {
public:
    /// Elapsed time in seconds.
    double seconds() const {
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
    }

private:
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

FAQEM_DETAIL_END
