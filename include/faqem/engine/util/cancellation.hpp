#pragma once
/// \file
/// Long loops ask now and then whether they are to go on.

#include <cstdint>
#include <functional>
#include <utility>

#include "faqem/export.hpp"
#include "faqem/progress.hpp"

FAQEM_NAMESPACE_BEGIN
namespace engine {

/// Thrown where the answer is to cancel; caught by the doors, which make a value of it.
struct Cancelled {};

/// Counts operations, and asks after every few thousand of them.
class ProgressMonitor {
public:
    /// Operations between two questions; each takes a microsecond or a few.
    static constexpr std::uint64_t interval = 4096;

    /// \param callback  may throw; not empty
    explicit ProgressMonitor(std::function<Continue()> callback) : callback_(std::move(callback)) {}
    ProgressMonitor(const ProgressMonitor&) = delete;
    ProgressMonitor& operator=(const ProgressMonitor&) = delete;

    /// \throws Cancelled, and what the question throws
    void count(std::uint64_t operations) {
        operations_ += operations;
        if (operations_ >= interval) check_now();
    }
    /// Asks at once. \throws as count()
    void check_now() {
        operations_ = 0;
        if (callback_() == Continue::cancel) throw Cancelled{};
    }

private:
    std::function<Continue()> callback_;
    std::uint64_t operations_ = 0;
};

/// What is handed down to loops; copies ask the same one. For the thread alone that it was made on.
class CancellationCheck {
public:
    /// Never asks.
    CancellationCheck() = default;
    /// \param monitor  borrowed
    explicit CancellationCheck(ProgressMonitor& monitor) : monitor_(&monitor) {}

    /// So many operations are about to be done. \throws as ProgressMonitor::count()
    void operator()(std::uint64_t operations = 1) const {
        if (monitor_) monitor_->count(operations);
    }
    /// \throws as ProgressMonitor::check_now()
    void now() const {
        if (monitor_) monitor_->check_now();
    }

private:
    ProgressMonitor* monitor_ = nullptr;
};

/// An order for sorting that polls. \param less  the order
template <class Less = std::less<>>
auto cancellable_less(CancellationCheck check_cancelled, Less less = {}) {
    return [=](const auto& a, const auto& b) {
        check_cancelled();
        return less(a, b);
    };
}

}  // namespace engine
FAQEM_NAMESPACE_END
