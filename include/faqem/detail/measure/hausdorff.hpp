#pragma once
/// \file
/// Hausdorff distance between surfaces by branch and bound, with a guaranteed upper bound.

#include <cstdint>
#include <limits>
#include <vector>

#include "faqem/detail/base/parallel.hpp"
#include "faqem/detail/geometry/surface.hpp"
#include "faqem/export.hpp"

FAQEM_DETAIL_BEGIN

/// The closest face of the other surface.
struct NearestFace {
    Index face = no_index;
    double distance_squared = 0;
};

/// For each position of `from`, finds the closest face of `to`.
/// \param tree        the tree of `to`, which must not be empty
/// \param stop_above  the search ends early, with fewer entries, soon after a distance above this is found;
///                    the number of entries does not depend on the number of threads. In model units.
/// O(positions log faces) typically
std::vector<NearestFace> nearest_faces_of_vertices(
    const Surface& from, const Surface& to, const Bvh& tree, const RunContext& context,
    double stop_above = std::numeric_limits<double>::infinity());

/// Absolute tolerance as a fraction of the diagonal. It lets the search end for identical meshes.
inline constexpr double min_relative_gap = 1e-9;

/// Termination criteria of a search. Distances in model units.
struct SearchLimits {
    double tolerance = 0.01;        ///< relative difference of bound and value; infinity: do not split faces
    double absolute_tolerance = 0;  ///< absolute difference of bound and value
    double stop_above = std::numeric_limits<double>::infinity();  ///< stop when the value exceeds this
    double stop_below = 0;                                        ///< stop when the bound is at most this
    std::uint64_t max_pieces = 0;  ///< maximum number of pieces of faces to evaluate
    /// If not null, the distance is only compared with `stop_below`: for each place of `from` that is farther, or is not
    /// decided, its face and the nearest face of `to` are added. `tolerance` is 0.
    std::vector<std::array<Index, 2>>* beyond = nullptr;
};

/// Lower and upper bound of a distance, in model units: value <= distance <= bound, up to rounding.
struct HausdorffBounds {
    double value = 0, bound = 0;
    std::uint64_t pieces = 0;  ///< number of pieces evaluated, not counting whole faces
};

/// Computes the one-sided Hausdorff distance from `from` to `to` by branch and bound. The distance to one
/// face is convex, so its maximum over a piece (a triangular part of a face) is at a corner; the smallest of
/// these maxima over a few nearby faces is an upper bound for the piece. For pairs of nearby faces, the piece
/// is also divided approximately where both are equally close, and each part is bounded by one of them. The
/// piece with the largest bound is split at its longest edge. The result does not depend on the number of
/// threads.
/// \param from         surface whose points are measured
/// \param to           surface to which distances are measured, not empty
/// \param tree         the tree of `to`
/// \param at_vertices  complete result of nearest_faces_of_vertices(from, to)
/// \param known        distance of some point of `from`, or 0; a lower bound of the result
/// \param limits       termination criteria
/// \throws whatever `context` throws
/// O((faces + pieces) log faces) typically; 150 bytes per open piece
HausdorffBounds one_sided_hausdorff(const Surface& from, const Surface& to, const Bvh& tree,
                                    const std::vector<NearestFace>& at_vertices, double known,
                                    const SearchLimits& limits, const RunContext& context = {});

/// Computes the two-sided Hausdorff distance, the larger one of both directions. If the value exceeds
/// limits.stop_above, the bound may be infinite.
/// \param a,b            surfaces, not empty
/// \param tree_a,tree_b  their trees
/// \throws whatever `context` throws
/// O((vertices + faces + pieces) log faces) typically
HausdorffBounds two_sided_hausdorff(const Surface& a, const Bvh& tree_a, const Surface& b, const Bvh& tree_b,
                                    const SearchLimits& limits, const RunContext& context = {});

FAQEM_DETAIL_END

#ifdef FAQEM_HEADER_ONLY
#include "faqem/detail/measure/hausdorff-inl.hpp"
#endif
