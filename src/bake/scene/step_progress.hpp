#pragma once
/// \file
/// Progress of work that is done in several steps.

#include <algorithm>
#include <memory>

#include "faqem/options.hpp"

namespace faqem::detail {

/// The options to do one step with: it is told of as a part of one phase, and never falls.
/// \param options   borrowed while the step goes on
/// \param reported_phase      the phase that the callback of `options` hears of
/// \param from, to  what is done of that phase before and after the step
inline Options step_options(const Options& options, Phase reported_phase, double from, double to) {
    Options own = options;
    if (!options.progress) return own;
    // Shared, because options are copied on the way.
    own.progress = [&options, reported_phase, from, to, most = std::make_shared<double>(0)](Phase phase,
                                                                                            double fraction) {
        // Baking tells of two phases, one after the other.
        if (phase == Phase::map) fraction = fraction / 2;
        if (phase == Phase::bake) fraction = (1 + fraction) / 2;
        *most = std::clamp(fraction, *most, 1.0);
        return options.progress(reported_phase, from + (to - from) * *most);
    };
    return own;
}

}  // namespace faqem::detail
