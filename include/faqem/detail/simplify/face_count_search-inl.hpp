#pragma once

#include "faqem/detail/simplify/face_count_search.hpp"

#include <algorithm>
#include <cmath>

#include "faqem/detail/base/portable_math.hpp"

FAQEM_DETAIL_BEGIN

inline constexpr double initial_ratio = 0.1;
inline constexpr double bracket_tolerance = 1.02;

/// Extrapolation from a single measured end is multiplied by this factor, so that the next point more often
/// lies on the other side of the solution.
inline constexpr double overshoot = 1.1;

/// Minimum distance of a guess from the ends of the bracket, as a share of its width; larger if both ends are
/// measured.
inline constexpr double margin = 0.05, measured_margin = 0.1;

FAQEM_INLINE FaceCountSearch::FaceCountSearch(std::uint64_t faces, double allowed)
    : allowed_(allowed), good_{static_cast<double>(faces)}, bad_{min_target_faces - 1} {}

FAQEM_INLINE bool FaceCountSearch::is_bracketing() const {
    return step_ == 0 && runs_ < bracket_runs && good_.faces > bad_.faces * bracket_tolerance &&
           good_.faces - bad_.faces > 1;
}

// The error of a smooth surface is proportional to 1 / faces. If both ends are measured: regula falsi, or
// bisection if the last guess did not halve the bracket. All in logarithms.
FAQEM_INLINE double FaceCountSearch::guess() const {
    const double low = portable_log(bad_.faces), high = portable_log(good_.faces);
    // Logarithm of error / allowed, clamped so that zero, infinite and NaN errors are usable.
    const auto log_excess = [&](double error) {
        if (error <= 0) return portable_log(1e-6);
        return error <= 1e6 * allowed_ ? portable_log(std::max(error / allowed_, 1e-6)) : portable_log(1e6);
    };
    double at;
    if (good_.error && bad_.error) {
        const double g = log_excess(*good_.error), b = log_excess(*bad_.error);
        double share = high - low > last_width_ / 2 ? 0.5 : g / (g - b);
        if (!(share >= measured_margin)) share = measured_margin;
        at = high + std::min(share, 1 - measured_margin) * (low - high);
    } else if (bad_.error) {
        at = low + log_excess(*bad_.error) + portable_log(overshoot);
    } else if (good_.error) {
        at = high + log_excess(*good_.error) - portable_log(overshoot);
    } else {
        at = high + portable_log(initial_ratio);
    }
    const double space = margin * (high - low);
    return portable_exp(at > low + space ? std::min(at, high - space) : low + space);
}

FAQEM_INLINE std::optional<std::uint64_t> FaceCountSearch::next() {
    if (is_bracketing()) {
        ++runs_;
        // There is an integer between the ends.
        const double count = std::clamp(std::round(guess()), bad_.faces + 1, good_.faces - 1);
        last_width_ = portable_log(good_.faces / bad_.faces);
        target_ = static_cast<std::uint64_t>(count);
        return target_;
    }
    while (step_ < refinement_ratios.size()) {
        const double count = std::floor(refinement_ratios[step_++] * good_.faces);
        if (count < reachable_) continue;
        target_ = static_cast<std::uint64_t>(count);
        return target_;
    }
    return std::nullopt;
}

FAQEM_INLINE void FaceCountSearch::add_result(std::uint64_t faces, double error, bool within) {
    const auto count = static_cast<double>(faces), target = static_cast<double>(target_);
    if (count > target) reachable_ = std::max(reachable_, std::min(count, good_.faces));
    if (within && count < good_.faces)
        good_ = {count, error};
    else if (step_ == 0 && target > bad_.faces)
        bad_ = {target, error};
    // Counts that runs cannot reach are not tried again.
    if (bad_.faces < reachable_ - 1) bad_ = {reachable_ - 1, std::nullopt};
}

FAQEM_DETAIL_END
