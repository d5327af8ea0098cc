#pragma once
/// \file
/// Cancellation checks in long loops.

#include <cstdint>
#include <functional>
#include <utility>

#include "faqem/export.hpp"
#include "faqem/progress.hpp"

FAQEM_NAMESPACE_BEGIN
namespace engine {

/// Thrown to cancel a computation. Public functions catch it and report the cancellation in their result.
struct Cancelled {};

/// Counts operations and calls a callback after every few thousand of them. Not thread-safe.
class ProgressMonitor {
public:
    /// Number of operations between two calls; an operation takes one to a few microseconds.
    static constexpr std::uint64_t interval = 4096;

    /// \param callback  returns whether to continue; must not be empty; may throw
    explicit ProgressMonitor(std::function<Continue()> callback) : callback_(std::move(callback)) {}
    ProgressMonitor(const ProgressMonitor&) = delete;
    ProgressMonitor& operator=(const ProgressMonitor&) = delete;

    /// Adds to the number of operations and calls the callback if `interval` is reached.
    /// \throws Cancelled if the callback returns Continue::cancel
    /// \throws whatever the callback throws
    void count(std::uint64_t operations) {
        operations_ += operations;
        if (operations_ >= interval) check_now();
    }
    /// Calls the callback now. \throws as count()
    void check_now() {
        operations_ = 0;
        if (callback_() == Continue::cancel) throw Cancelled{};
    }

private:
    std::function<Continue()> callback_;
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
