#pragma once
/// \file
/// What one call of a public function shares with everything inside it: threads, progress, cancellation and time.

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <optional>
#include <utility>

#include "faqem/export.hpp"
#include "faqem/options.hpp"
#include "faqem/progress.hpp"
#include "faqem/report.hpp"

FAQEM_ENGINE_BEGIN

/// Thrown to stop a computation. Public functions catch it and report the reason in their result.
struct Cancelled {
    StopReason reason = StopReason::cancelled;  ///< or reached_time_limit
};

/// Made once by a public function, and passed by reference. It may be used only on the thread that made it, since it
/// calls the progress callback: parallel_blocks() gives each of its threads one of its own.
class RunContext {
public:
    using Deadline = std::chrono::steady_clock::time_point;
    static constexpr Deadline no_deadline = Deadline::max();
    /// Number of operations between two checks; an operation takes one to a few microseconds.
    static constexpr std::uint64_t interval = 4096;

    /// \param max_threads  0: one per hardware thread
    /// \param progress     may be empty; may throw
    // Not explicit, so that callers without progress can pass a number of threads.
    RunContext(std::uint32_t max_threads = 0, Progress progress = {}, Deadline deadline = no_deadline)
        : threads(max_threads), progress_(std::move(progress)), deadline_(deadline) {}
    /// \param options  need not be valid; Options::max_seconds counts from now
    explicit RunContext(const Options& options)
        : RunContext(options.threads, options.progress, deadline_in(options.max_seconds)) {}
    RunContext(const RunContext&) = delete;
    RunContext& operator=(const RunContext&) = delete;

    /// All threads, and nothing stops it. Other than the rest, it may be used on any thread.
    static const RunContext& endless() {
        static const RunContext context;
        return context;
    }

    const std::uint32_t threads;  ///< maximum number; 0: one per hardware thread

    /// Counts operations that follow, and checks if these are `interval` since the last check.
    /// \throws as check_now()
    void count(std::uint64_t operations = 1) const {
        if (!can_stop()) return;
        operations_ += operations;
        if (operations_ >= interval) check_now();
    }
    /// Calls the progress callback, and looks at the time.
    /// \throws Cancelled if the callback cancels, or the deadline is over
    /// \throws whatever the callback throws
    void check_now() const {
        if (!can_stop()) return;
        operations_ = 0;
        if (ask() == Continue::cancel) throw Cancelled{};
        if (is_late()) throw Cancelled{StopReason::reached_time_limit};
    }
    /// Calls the progress callback with what was shown last.
    Continue ask() const { return progress_ ? progress_(shown_.first, shown_.second) : Continue::yes; }
    /// Sets what the following checks report. An earlier phase or a smaller fraction than before changes nothing.
    void show(Phase phase, double fraction) const {
        if (progress_) shown_ = std::max(shown_, std::pair(phase, std::min(fraction, 1.0)));
    }
    /// show() and check_now().
    void report(Phase phase, double fraction) const {
        show(phase, fraction);
        check_now();
    }

    /// Whether the deadline is over.
    bool is_late() const { return deadline_ != no_deadline && std::chrono::steady_clock::now() >= deadline_; }
    Deadline deadline() const { return deadline_; }

    /// Does work that the deadline may stop.
    /// \return false if it was over before the work was complete
    /// \throws Cancelled if the callback cancels, and whatever it and `work` throw
    template <class Work>
    bool in_time(Work&& work) const {
        try {
            work();
            return true;
        } catch (const Cancelled& stopped) {
            if (stopped.reason == StopReason::cancelled) throw;
            return false;
        }
    }

    /// For one step of the work, which this must outlive. Its progress is reported as a range of one phase.
    /// \param phase     that is shown
    /// \param from, to  fractions of this phase that are done before and after the step
    RunContext step(Phase phase, double from, double to) const {
        return within(threads, deadline_, [this, phase, from, to](Phase inner, double fraction) {
            // bake() reports two phases one after the other: each is half of the step.
            if (inner == Phase::map) fraction = fraction / 2;
            if (inner == Phase::bake) fraction = (1 + fraction) / 2;
            show(phase, from + (to - from) * fraction);
            return ask();
        });
    }
    /// For a step whose own progress is not shown.
    RunContext quiet() const { return step(shown_.first, shown_.second, shown_.second); }
    /// The same on one thread.
    RunContext on_one_thread() const { return within(1, deadline_, passed_on()); }
    /// For work that is always completed, whatever the time.
    RunContext untimed() const { return within(threads, no_deadline, passed_on()); }

private:
    bool can_stop() const { return progress_ || deadline_ != no_deadline; }
    static Deadline deadline_in(const std::optional<double>& max_seconds) {
        constexpr double longest = 1e9;  // does not overflow as nanoseconds
        const double seconds = max_seconds.value_or(longest);
        if (!(seconds > 0 && seconds < longest)) return no_deadline;
        const std::chrono::duration<double> limit(seconds);
        return std::chrono::steady_clock::now() + std::chrono::duration_cast<Deadline::duration>(limit);
    }
    RunContext within(std::uint32_t max_threads, Deadline deadline, Progress progress) const {
        return RunContext(max_threads, progress_ ? std::move(progress) : Progress(), deadline);
    }
    Progress passed_on() const {
        return [this](Phase phase, double fraction) {
            show(phase, fraction);
            return ask();
        };
    }

    Progress progress_;
    Deadline deadline_;
    // Change in const functions, since they are the state of the callback.
    mutable std::uint64_t operations_ = 0;
    mutable std::pair<Phase, double> shown_ = {Phase::load, 0};
};

FAQEM_ENGINE_END
