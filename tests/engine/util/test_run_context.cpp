#include "faqem/engine/util/run_context.hpp"

#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

#include "support/catch.hpp"

using namespace faqem;
using engine::Cancelled;
using engine::RunContext;

namespace {

using Calls = std::vector<std::pair<Phase, double>>;

const RunContext::Deadline past = std::chrono::steady_clock::now();
const RunContext::Deadline far_future = past + std::chrono::hours(10'000);

Progress recorded(Calls& calls) {
    return [&calls](Phase phase, double fraction) {
        calls.emplace_back(phase, fraction);
        return Continue::yes;
    };
}

// Why a check stops.
std::optional<StopReason> stop_reason(const RunContext& context) {
    try {
        context.check_now();
    } catch (const Cancelled& stopped) {
        return stopped.reason;
    }
    return {};
}

Continue cancel(Phase, double) { return Continue::cancel; }

}  // namespace

TEST_CASE("run context: stops at its deadline, and a callback that cancels comes first") {
    CHECK(stop_reason({1, {}, past}) == StopReason::reached_time_limit);
    CHECK(stop_reason({1, cancel, past}) == StopReason::cancelled);
    CHECK(stop_reason({1, cancel}) == StopReason::cancelled);
    CHECK(stop_reason({1, {}, far_future}) == std::nullopt);
    CHECK(stop_reason({}) == std::nullopt);
    CHECK(stop_reason(RunContext::endless()) == std::nullopt);
}

TEST_CASE("run context: has the threads, the callback and the time of the options") {
    Calls calls;
    const RunContext context({.max_seconds = 1e8, .threads = 3, .progress = recorded(calls)});
    CHECK(context.threads == 3);
    CHECK(context.deadline() > far_future);
    CHECK_FALSE(context.is_late());
    context.report(Phase::weld, 0.5);
    CHECK(calls == Calls{{Phase::weld, 0.5}});
    CHECK(RunContext(Options{.max_seconds = 1e-9}).is_late());
    for (const double endless : {0.0, -1.0, 1e300})
        CHECK(RunContext(Options{.max_seconds = endless}).deadline() == RunContext::no_deadline);
    CHECK(RunContext(Options{}).deadline() == RunContext::no_deadline);
}

TEST_CASE("run context: checks after every interval of operations") {
    Calls calls;
    const RunContext context(1, recorded(calls));
    for (std::uint64_t i = 0; i < 3 * RunContext::interval; ++i) context.count();
    CHECK(calls.size() == 3);
    context.count(RunContext::interval - 1);
    CHECK(calls.size() == 3);
    context.count(1);
    CHECK(calls.size() == 4);
}

TEST_CASE("run context: reported phases and fractions never go back") {
    Calls calls;
    const RunContext context(1, recorded(calls));
    context.report(Phase::simplify, 0.5);
    context.report(Phase::simplify, 0.25);
    context.report(Phase::bake, 0.125);
    context.report(Phase::map, 1);
    context.report(Phase::bake, 2);
    CHECK(calls == Calls{{Phase::simplify, 0.5},
                         {Phase::simplify, 0.5},
                         {Phase::bake, 0.125},
                         {Phase::bake, 0.125},
                         {Phase::bake, 1}});
}

TEST_CASE("run context: steps report ranges of a phase, and have the same threads and time") {
    Calls calls;
    const RunContext context(3, recorded(calls), far_future);
    {
        const RunContext step = context.step(Phase::simplify, 0.5, 1);
        CHECK(step.threads == 3);
        CHECK(step.deadline() == far_future);
        step.report(Phase::weld, 0);
        step.step(Phase::simplify, 0, 0.5).report(Phase::simplify, 0.5);
    }
    const RunContext baked = context.step(Phase::bake, 0, 0.5);
    baked.report(Phase::map, 0.5);
    baked.report(Phase::bake, 0.5);
    baked.quiet().report(Phase::bake, 1);
    CHECK(calls == Calls{{Phase::simplify, 0.5},
                         {Phase::simplify, 0.625},
                         {Phase::bake, 0.125},
                         {Phase::bake, 0.375},
                         {Phase::bake, 0.375}});
}

TEST_CASE("run context: work that is always completed reports the same, but has no deadline") {
    Calls calls;
    const RunContext late(3, recorded(calls), past);
    late.untimed().report(Phase::map, 0.5);
    CHECK(late.untimed().threads == 3);
    CHECK(calls == Calls{{Phase::map, 0.5}});
    CHECK(late.on_one_thread().threads == 1);
    CHECK(stop_reason(late.on_one_thread()) == StopReason::reached_time_limit);
    CHECK(stop_reason(RunContext(1, cancel).untimed()) == StopReason::cancelled);
}

TEST_CASE("run context: work in time ends with the deadline, and other exceptions pass through") {
    const RunContext late(1, {}, past), in_time(1, {}, far_future);
    CHECK_FALSE(late.in_time([&] { late.check_now(); }));
    CHECK(in_time.in_time([&] { in_time.check_now(); }));
    const RunContext cancelled(1, cancel);
    CHECK_THROWS_AS(cancelled.in_time([&] { cancelled.check_now(); }), Cancelled);
    CHECK_THROWS_WITH(in_time.in_time([] { throw std::runtime_error("own"); }), "own");
}
