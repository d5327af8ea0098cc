#pragma once
/// \file
/// The number of basic blocks executed between two cancellation checks.

#include <algorithm>
#include <cstdint>
#include <functional>

#include "faqem/engine/util/cancellation.hpp"
#include "step_counts/steps.hpp"
#include "support/catch.hpp"

namespace faqem::test {

/// Limit of the number of basic blocks between two checks: a few milliseconds, or a few thousand
/// evaluations of a pair with a few hundred basic blocks each, if little is inlined.
inline constexpr std::uint64_t most_steps = 2'000'000;

/// Measures the largest number of basic blocks between two cancellation checks.
class Watch {
public:
    engine::CancellationCheck check_cancelled() { return engine::CancellationCheck(monitor_); }
    std::function<Continue(double)> progress() {
        return [this](double) { return note(), Continue::yes; };
    }
    void note() {
        longest_ = std::max(longest_, test::steps() - last_);
        last_ = test::steps();
        ++calls_;
    }
    /// The maximum since construction, including the time before the first check and after the last one.
    /// Requires at least two checks.
    std::uint64_t longest() {
        note();
        CHECK(calls_ > 2);
        return longest_;
    }

private:
    std::uint64_t last_ = test::steps(), longest_ = 0;
    int calls_ = 0;
    engine::ProgressMonitor monitor_{[this] { return note(), Continue::yes; }};
};

/// The largest number of basic blocks between two checks in work(check_cancelled).
template <class Work>
std::uint64_t longest_silence(Work&& work) {
    Watch watch;
    work(watch.check_cancelled());
    return watch.longest();
}

}  // namespace faqem::test
