#pragma once
/// \file
/// How much is done between two questions, counted by the compiler.

#include <algorithm>
#include <catch2/catch.hpp>
#include <cstdint>
#include <functional>

#include "faqem/engine/util/cancellation.hpp"
#include "step_counts/steps.hpp"

namespace faqem::test {

/// A few thousandths of a second: a few thousand evaluations of a pair, of a few hundred basic blocks each
/// where little is inlined.
inline constexpr std::uint64_t most_steps = 2'000'000;

/// How long nobody was asked.
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
    /// From the beginning of the work to its end; less than that was not asked for.
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

/// The most steps between two questions of work(poll).
template <class Work>
std::uint64_t longest_silence(Work&& work) {
    Watch watch;
    work(watch.check_cancelled());
    return watch.longest();
}

}  // namespace faqem::test
