#pragma once
/// \file
/// Options, time and progress of a search that is done in several steps.

#include "faqem/detail/base/time_limit.hpp"
#include "faqem/options.hpp"

namespace faqem::detail {

/// What the steps of a search have in common. Not copied.
class SearchSteps {
public:
    /// \param options  those of the search; Options::max_seconds counts from now
    explicit SearchSteps(const Options& options) : options_(options) { monitor_.set_deadline(deadline_); }
    SearchSteps(const SearchSteps&) = delete;
    SearchSteps& operator=(const SearchSteps&) = delete;

    /// The options of the steps, which the search may change.
    Options& options() { return options_; }
    const Options& options() const { return options_; }

    Deadline deadline() const { return deadline_; }

    /// Whether Options::max_seconds is over.
    bool is_late() const { return engine::is_over(deadline_); }

    /// Reports a share of Phase::bake, and shows the same for the steps that follow.
    /// \throws engine::Cancelled  the progress callback cancels, or the time is over
    void report(double fraction) {
        fraction_ = fraction;
        monitor_.check_now();
    }

    /// Options of a step whose own progress is not shown. \pre it is used while this exists
    Options step() const {
        Options own = options_;
        own.progress = [this](Phase, double) { return shown_progress(); };
        return own;
    }

    /// Throws if the progress callback cancels, or the time is over. \throws engine::Cancelled
    void check() { monitor_.check_now(); }

    /// Threads of a step, with this check.
    Workers workers() { return {options_.threads, CancellationCheck(monitor_)}; }

private:
    Continue shown_progress() const {
        return options_.progress ? options_.progress(Phase::bake, fraction_) : Continue::yes;
    }

    Options options_;
    Deadline deadline_ = deadline_of(options_);
    double fraction_ = 0;
    engine::ProgressMonitor monitor_{[this] { return shown_progress(); }};
};

}  // namespace faqem::detail
