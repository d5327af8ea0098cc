#pragma once

#include "faqem/export.hpp"
#include "faqem/detail/geometry/random_sampling.hpp"

#include <algorithm>
#include <cmath>

#include "faqem/engine/util/hash.hpp"

FAQEM_NAMESPACE_BEGIN
namespace detail {

/// A number in [0, 1) that depends on its arguments only.
inline double uniform(std::uint64_t seed, std::uint64_t sample, std::uint64_t dimension) {
    const auto mix = [](std::uint64_t x) { return engine::scrambled(x + 0x9e3779b97f4a7c15u); };
    return static_cast<double>(mix(mix(mix(seed) + dimension) + sample) >> 11) * 0x1p-53;
}

FAQEM_INLINE SurfaceSample sample(const Surface& s, std::uint64_t i, std::uint64_t n, std::uint64_t seed) {
    const double place =
        (static_cast<double>(i) + uniform(seed, i, 0)) / static_cast<double>(n) * s.area_up_to.back();
    const auto found = std::lower_bound(s.area_up_to.begin(), s.area_up_to.end(), place);
    const auto face = static_cast<Index>(
        std::min<std::ptrdiff_t>(found - s.area_up_to.begin(), std::ssize(s.area_up_to) - 1));
    const double r = std::sqrt(uniform(seed, i, 1)), t = uniform(seed, i, 2);
    const Vec3 w = {1 - r, r * (1 - t), r * t};
    const engine::Vector3 p = w[0] * s.corner(face, 0) + w[1] * s.corner(face, 1) + w[2] * s.corner(face, 2);
    return {face, w, engine::to_array(p)};
}

}  // namespace detail
FAQEM_NAMESPACE_END
