#pragma once
/// \file
/// Options::max_seconds as a deadline, which the steps of one call share.

#include <algorithm>
#include <chrono>

#include "faqem/engine/util/cancellation.hpp"
#include "faqem/export.hpp"
#include "faqem/options.hpp"

FAQEM_NAMESPACE_BEGIN
namespace detail {

using engine::Deadline;
using engine::no_deadline;

/// When work that begins now must end.
/// \param options  of the whole work; need not be valid
/// \return no_deadline without a limit, or with one of more than 30 years
inline Deadline deadline_of(const Options& options) {
    constexpr double longest = 1e9;  // does not overflow as nanoseconds
    const double seconds = options.max_seconds.value_or(longest);
    if (!(seconds > 0 && seconds < longest)) return no_deadline;
    const std::chrono::duration<double> limit(seconds);
    return std::chrono::steady_clock::now() + std::chrono::duration_cast<Deadline::duration>(limit);
}

/// Options of a step that begins now.
/// \param options   of the whole work
/// \param deadline  deadline_of(options) when the work began
/// \return the options with the time until the deadline as their limit; with 1 ns, which is valid, if that is over
inline Options with_time_left(Options options, Deadline deadline) {
    if (deadline == no_deadline) return options;
    const std::chrono::duration<double> left = deadline - std::chrono::steady_clock::now();
    options.max_seconds = std::max(left.count(), 1e-9);
    return options;
}

}  // namespace detail
FAQEM_NAMESPACE_END
