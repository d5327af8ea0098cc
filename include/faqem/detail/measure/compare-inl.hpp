#pragma once

#include "faqem/compare.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "faqem/detail/base/parallel.hpp"
#include "faqem/detail/base/portable_math.hpp"
#include "faqem/detail/geometry/bvh.hpp"
#include "faqem/detail/geometry/random_sampling.hpp"
#include "faqem/detail/measure/hausdorff.hpp"
#include "faqem/error.hpp"

FAQEM_NAMESPACE_BEGIN

namespace detail {

inline constexpr std::size_t comparison_block = 4096;
inline constexpr double degrees_per_radian = 57.295779513082320877;

/// Faces whose distances differ by less than this fraction of the diagonal count as equally close.
inline constexpr double normal_tie_tolerance = 1e-9;

/// DistanceSums over samples; `max_squared` is a maximum.
struct DistanceSums {
    double max_squared = 0, distance = 0, squared = 0, degrees = 0;
};

inline detail::SearchLimits search_limits(double tolerance, double diagonal) {
    if (!(tolerance >= 0)) throw OptionError("tolerance must be >= 0");
    return {.tolerance = tolerance,
            .absolute_tolerance = detail::min_relative_gap * diagonal,
            .max_pieces = HausdorffOptions{}.max_pieces};
}

inline OneSided one_sided(const Surface& from, const Surface& to, const Bvh& tree,
                          const CompareOptions& options, std::uint64_t seed, double tie,
                          const detail::SearchLimits& limits) {
    // By block, so that totals do not depend on the number of threads.
    std::vector<DistanceSums> sums((options.samples + comparison_block - 1) / comparison_block);
    parallel_blocks(
        options.samples, comparison_block, options.threads, [&](std::size_t begin, std::size_t end) {
            DistanceSums& sum = sums[begin / comparison_block];
            CoherentQuery query(to, tree);
            for (std::size_t i = begin; i < end; ++i) {
                const detail::RandomSample s = sample(from, i, options.samples, seed);
                const Bvh::Hit hit = query(s.point);
                const double cosine =
                    detail::max_normal_cosine(tree, to.normals, s.point, hit, from.normals[s.face], tie);
                sum.max_squared = std::max(sum.max_squared, hit.distance_squared);
                sum.distance += std::sqrt(hit.distance_squared);
                sum.squared += hit.distance_squared;
                sum.degrees += detail::portable_acos(std::max(cosine, -1.0)) * degrees_per_radian;
            }
        });
    DistanceSums total;
    for (const DistanceSums& s : sums) {
        total.max_squared = std::max(total.max_squared, s.max_squared);
        total.distance += s.distance;
        total.squared += s.squared;
        total.degrees += s.degrees;
    }
    const detail::HausdorffBounds most = detail::one_sided_hausdorff(
        from, to, tree, detail::nearest_faces_of_vertices(from, to, tree, options.threads),
        std::sqrt(total.max_squared), limits, options.threads);
    const double n = static_cast<double>(std::max<std::uint64_t>(options.samples, 1));
    return {.max = most.value,
            .max_bound = most.bound,
            .mean = total.distance / n,
            .mean_squared = total.squared / n,
            .mean_normal_degrees = total.degrees / n};
}

}  // namespace detail

FAQEM_INLINE Comparison compare(const MeshView& a, const MeshView& b, const CompareOptions& options) {
    const detail::Surface sa = detail::extract_nonempty_surface(a, "first mesh"),
                          sb = detail::extract_nonempty_surface(b, "second mesh");
    Comparison result;
    result.diagonal = sa.diagonal();
    const detail::SearchLimits limits = detail::search_limits(options.tolerance, result.diagonal);
    const detail::Bvh ta(sa.positions, sa.triangles), tb(sb.positions, sb.triangles);
    const double tie = detail::normal_tie_tolerance * result.diagonal;
    result.a_to_b = detail::one_sided(sa, sb, tb, options, 2 * options.seed, tie, limits);
    result.b_to_a = detail::one_sided(sb, sa, ta, options, 2 * options.seed + 1, tie, limits);
    result.hausdorff = std::max(result.a_to_b.max, result.b_to_a.max);
    result.hausdorff_bound = std::max(result.a_to_b.max_bound, result.b_to_a.max_bound);
    result.chamfer = result.a_to_b.mean_squared + result.b_to_a.mean_squared;
    result.mean_normal_degrees = (result.a_to_b.mean_normal_degrees + result.b_to_a.mean_normal_degrees) / 2;
    return result;
}

FAQEM_INLINE DistanceBound hausdorff(const MeshView& a, const MeshView& b, const HausdorffOptions& options) {
    const detail::Surface sa = detail::extract_nonempty_surface(a, "first mesh"),
                          sb = detail::extract_nonempty_surface(b, "second mesh");
    detail::SearchLimits limits = detail::search_limits(options.tolerance, sa.diagonal());
    limits.stop_above = options.stop_above;
    limits.stop_below = options.stop_below;
    limits.max_pieces = options.max_pieces;
    const detail::Bvh ta(sa.positions, sa.triangles), tb(sb.positions, sb.triangles);
    const detail::HausdorffBounds most = detail::two_sided_hausdorff(sa, ta, sb, tb, limits, options.threads);
    return {most.value, most.bound, most.pieces};
}

FAQEM_INLINE Within within(const MeshView& a, const MeshView& b, double distance, std::uint32_t threads) {
    const DistanceBound found =
        hausdorff(a, b, {.tolerance = 0, .threads = threads, .stop_above = distance, .stop_below = distance});
    if (found.bound <= distance) return Within::yes;
    return found.value > distance ? Within::no : Within::undecided;
}

FAQEM_NAMESPACE_END
