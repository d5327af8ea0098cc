#pragma once

#include "faqem/detail/geometry/random_sampling.hpp"

#include <algorithm>
#include <cmath>

#include "faqem/engine/util/hash.hpp"

FAQEM_DETAIL_BEGIN

/// Pseudorandom number in [0, 1): a hash of the arguments (SplitMix64).
inline double uniform(std::uint64_t seed, std::uint64_t sample, std::uint64_t dimension) {
    const auto mix = [](std::uint64_t x) { return engine::splitmix64(x + 0x9e3779b97f4a7c15u); };
    return static_cast<double>(mix(mix(mix(seed) + dimension) + sample) >> 11) * 0x1p-53;
}

FAQEM_INLINE RandomSample sample(const Surface& s, std::uint64_t i, std::uint64_t n, std::uint64_t seed) {
    const double area_position =
        (static_cast<double>(i) + uniform(seed, i, 0)) / static_cast<double>(n) * s.cumulative_area.back();
    const auto found = std::lower_bound(s.cumulative_area.begin(), s.cumulative_area.end(), area_position);
    const auto face = static_cast<Index>(
        std::min<std::ptrdiff_t>(found - s.cumulative_area.begin(), std::ssize(s.cumulative_area) - 1));
    const double r = std::sqrt(uniform(seed, i, 1)), t = uniform(seed, i, 2);
    const Vec3 w = {1 - r, r * (1 - t), r * t};
    const Vector3 p = w[0] * s.corner(face, 0) + w[1] * s.corner(face, 1) + w[2] * s.corner(face, 2);
    return {face, w, to_array(p)};
}

FAQEM_DETAIL_END
