#pragma once
/// \file
/// The largest distance from one surface to another, with a proven bound.

#include <cstdint>
#include <limits>
#include <vector>

#include "faqem/detail/base/parallel.hpp"
#include "faqem/detail/geometry/surface.hpp"
#include "faqem/export.hpp"

FAQEM_NAMESPACE_BEGIN
namespace detail {

/// The nearest face of the other surface.
struct NearestFace {
    Index face = no_index;
    double distance_squared = 0;
};

/// Per position of `from` the nearest face of `to`. Ends early, with fewer entries, once one of them is
/// farther than stop_above; how early does not depend on the number of threads.
std::vector<NearestFace> nearest_faces_of_vertices(
    const Surface& from, const Surface& to, const Bvh& tree, Workers workers,
    double stop_above = std::numeric_limits<double>::infinity());

/// A gap between value and bound below this share of the diagonal is none: identical meshes have to end.
inline constexpr double min_relative_gap = 1e-9;

/// What a search is to reach, and what ends it. Distances in model units.
struct SearchLimits {
    double tolerance = 0.01;        ///< relative gap; infinity: bounds of whole faces only
    double absolute_tolerance = 0;  ///< absolute gap that is as good as none
    double stop_above = std::numeric_limits<double>::infinity();  ///< give up once the value exceeds it
    double stop_below = 0;                                        ///< a bound this low is good enough
    std::uint64_t max_pieces = 0;                                 ///< parts of faces to look at
    Workers workers = {};
};

/// No point of the one surface is farther than `bound` from the other, and one is `value` away.
struct HausdorffBounds {
    double value = 0, bound = 0;
    std::uint64_t pieces = 0;  ///< parts of faces looked at, beyond the whole faces
};

/// The largest distance from `from` to `to`, by branch and bound. The distance to one face is convex, so that
/// over a part of a face it is largest at a corner; the smallest of these maxima over a few nearby faces
/// bounds the part. Where two faces are nearby the part is cut in thought where they are equally near, and
/// either bounds its side. The part with the largest bound is split at its longest edge. Results do not
/// depend on the number of threads.
/// \param tree         that of `to`
/// \param at_vertices  nearest_faces_of_vertices(from, to), complete
/// \param known        a distance that some point of `from` is known to have
/// O((faces + pieces) log faces) typically; 150 bytes per piece that is still open.
HausdorffBounds one_sided_hausdorff(const Surface& from, const Surface& to, const Bvh& tree,
                                    const std::vector<NearestFace>& at_vertices, double known,
                                    const SearchLimits& limits);

/// The larger of both directions. Where the value exceeds stop_above the bound may be infinite, and the other
/// direction unknown.
/// \param tree_a  that of `a`, as tree_b is that of `b`
HausdorffBounds two_sided_hausdorff(const Surface& a, const Bvh& tree_a, const Surface& b, const Bvh& tree_b,
                                    const SearchLimits& limits);

}  // namespace detail
FAQEM_NAMESPACE_END

#ifdef FAQEM_HEADER_ONLY
#include "faqem/detail/measure/hausdorff-inl.hpp"
#endif
