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
class Asker {
public:
    /// Operations between two questions; each takes a microsecond or a few.
    static constexpr std::uint64_t interval = 4096;

    /// \param ask  may throw; not empty
    explicit Asker(std::function<Continue()> ask) : ask_(std::move(ask)) {}
    Asker(const Asker&) = delete;
    Asker& operator=(const Asker&) = delete;

    /// \throws Cancelled, and what the question throws
    void count(std::uint64_t operations) {
        counted_ += operations;
        if (counted_ >= interval) ask();
    }
    /// Asks at once. \throws as count()
    void ask() {
        counted_ = 0;
        if (ask_() == Continue::cancel) throw Cancelled{};
    }

private:
    std::function<Continue()> ask_;
    std::uint64_t counted_ = 0;
};

/// What is handed down to loops; copies ask the same one. For the thread alone that it was made on.
class Poll {
public:
    /// Never asks.
    Poll() = default;
    /// \param asker  borrowed
    explicit Poll(Asker& asker) : asker_(&asker) {}

    /// So many operations are about to be done. \throws as Asker::count()
    void operator()(std::uint64_t operations = 1) const {
        if (asker_) asker_->count(operations);
    }
    /// \throws as Asker::ask()
    void now() const {
        if (asker_) asker_->ask();
    }

private:
    Asker* asker_ = nullptr;
};

/// An order for sorting that polls. \param less  the order
template <class Less = std::less<>>
auto polled_less(Poll poll, Less less = {}) {
    return [=](const auto& a, const auto& b) {
        poll();
        return less(a, b);
    };
}

}  // namespace engine
FAQEM_NAMESPACE_END
