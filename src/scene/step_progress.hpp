#pragma once
/// \file
/// Progress of work that is done in several steps.

#include <algorithm>
#include <memory>

#include "faqem/options.hpp"

namespace faqem::detail {

/// Options for one step of the work. Its progress is reported as a range of one phase, and never decreases.
/// \param options         must outlive the step
/// \param reported_phase  phase that is passed to the callback of `options`
/// \param from            fraction of this phase that is done before the step
/// \param to              fraction of this phase that is done after the step
inline Options step_options(const Options& options, Phase reported_phase, double from, double to) {
    Options own = options;
    if (!options.progress) return own;
    // The maximum is shared between copies of the options.
    own.progress = [&options, reported_phase, from, to, max = std::make_shared<double>(0)](Phase phase,
                                                                                           double fraction) {
        // bake() reports two phases one after the other: each is half of the step.
        if (phase == Phase::map) fraction = fraction / 2;
        if (phase == Phase::bake) fraction = (1 + fraction) / 2;
        *max = std::clamp(fraction, *max, 1.0);
        return options.progress(reported_phase, from + (to - from) * *max);
    };
    return own;
}

}  // namespace faqem::detail
