#pragma once
/// \file
/// The number of basic blocks executed between two cancellation checks.

#include <algorithm>
#include <cstdint>
#include <functional>

#include "faqem/engine/util/run_context.hpp"
#include "step_counts/steps.hpp"
#include "support/catch.hpp"

namespace faqem::test {

/// Limit of the number of basic blocks between two checks on a mesh of a million faces: about 0.3 seconds.
inline constexpr std::uint64_t most_steps = 300'000'000;

/// An estimate of the number of basic blocks between two checks on a mesh of a million faces, from the number on
/// a mesh with fewer faces. Steps without checks take linear time.
inline std::uint64_t for_a_million_faces(std::uint64_t steps, std::size_t faces) {
    return steps * 1'000'000 / faces;
}

/// Measures the largest number of basic blocks between two cancellation checks.
class Watch {
public:
    const engine::RunContext& context() const { return context_; }
    std::function<Continue(double)> progress() {
        return [this](double) { return note(), Continue::yes; };
    }
    /// Leaves out what was done since construction. The measured work begins now.
    void start() { last_ = test::steps(); }
    void note() {
        longest_ = std::max(longest_, test::steps() - last_);
        last_ = test::steps();
        ++calls_;
    }
    /// The maximum since construction or start(), including the time before the first check and after the last one.
    /// Requires at least two checks.
    std::uint64_t longest() {
        note();
        CHECK(calls_ > 2);
        return longest_;
    }

private:
    std::uint64_t last_ = test::steps(), longest_ = 0;
    int calls_ = 0;
    engine::RunContext context_{1, [this](Phase, double) { return note(), Continue::yes; }};
};

/// The largest number of basic blocks between two checks in work(context).
template <class Work>
std::uint64_t longest_silence(Work&& work) {
    Watch watch;
    work(watch.context());
    return watch.longest();
}

}  // namespace faqem::test
