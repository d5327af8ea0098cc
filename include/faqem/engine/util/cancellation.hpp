#pragma once
/// \file
/// Checks for cancellation and time limits in long loops.

#include <chrono>
#include <cstdint>
#include <functional>
#include <utility>

#include "faqem/export.hpp"
#include "faqem/progress.hpp"
#include "faqem/report.hpp"

FAQEM_NAMESPACE_BEGIN
namespace engine {

/// Thrown to stop a computation. Public functions catch it and report the reason in their result.
struct Cancelled {
    StopReason reason = StopReason::cancelled;  ///< or reached_time_limit
};

/// Point in time at which a computation is stopped.
using Deadline = std::chrono::steady_clock::time_point;
inline constexpr Deadline no_deadline = Deadline::max();

/// Returns whether the deadline is over.
inline bool is_over(Deadline deadline) {
    return deadline != no_deadline && std::chrono::steady_clock::now() >= deadline;
}

/// Counts operations and calls a callback after every few thousand of them. Not thread-safe.
class ProgressMonitor {
public:
    /// Number of operations between two calls; an operation takes one to a few microseconds.
    static constexpr std::uint64_t interval = 4096;

    /// \param callback  returns whether to continue; may be empty; may throw
    explicit ProgressMonitor(std::function<Continue()> callback) : callback_(std::move(callback)) {}
    ProgressMonitor(const ProgressMonitor&) = delete;
    ProgressMonitor& operator=(const ProgressMonitor&) = delete;

    /// Sets a time limit; without a call there is none.
    void set_deadline(Deadline deadline) { deadline_ = deadline; }

    /// Adds to the number of operations and calls the callback if `interval` is reached.
    /// \throws Cancelled if the callback returns Continue::cancel, or the deadline is over
    /// \throws whatever the callback throws
    void count(std::uint64_t operations) {
        operations_ += operations;
        if (operations_ >= interval) check_now();
    }
    /// Calls the callback now. \throws as count()
    void check_now() {
        operations_ = 0;
        if (callback_ && callback_() == Continue::cancel) throw Cancelled{};
        if (is_over(deadline_)) throw Cancelled{StopReason::reached_time_limit};
    }

private:
    std::function<Continue()> callback_;
    Deadline deadline_ = no_deadline;
    std::uint64_t operations_ = 0;
};

/// Cancellation check that is passed by value to long loops. All copies share one monitor, and may be used
/// only on the thread that created it.
class CancellationCheck {
public:
    /// Never cancels.
    CancellationCheck() = default;
    /// \param monitor  borrowed; must outlive all copies
    explicit CancellationCheck(ProgressMonitor& monitor) : monitor_(&monitor) {}

    /// Counts operations.
    /// \param operations  number of operations that follow
    /// \throws as ProgressMonitor::count()
    void operator()(std::uint64_t operations = 1) const {
        if (monitor_) monitor_->count(operations);
    }
    /// Checks now. \throws as ProgressMonitor::check_now()
    void now() const {
        if (monitor_) monitor_->check_now();
    }

private:
    ProgressMonitor* monitor_ = nullptr;
};

}  // namespace engine
FAQEM_NAMESPACE_END
