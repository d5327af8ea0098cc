#pragma once
/// \file
/// Time for the report.

#include <chrono>

#include "faqem/export.hpp"

FAQEM_NAMESPACE_BEGIN
namespace detail {

/// Wall-clock seconds since it was made.
class Stopwatch {
public:
    double seconds() const {
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
    }

private:
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace detail
FAQEM_NAMESPACE_END
