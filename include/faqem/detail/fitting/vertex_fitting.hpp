#pragma once
/// \file
/// Fits the vertices of a simplified mesh to the original surface, optionally with edge flips.

#include <cstdint>
#include <span>
#include <vector>

#include "faqem/detail/fitting/edge_flip_search.hpp"
#include "faqem/export.hpp"

FAQEM_DETAIL_BEGIN

/// Whether fit_vertices() may flip edges. Without flips the connectivity is kept.
enum class EdgeFlips { off, on };

/// Result of fit_vertices().
struct FittingResult {
    std::vector<Vector3> positions;  ///< of all vertices of the simplified mesh
    std::vector<EdgeFlip> flips;     ///< in the order in which they were made
};

/// Moves the vertices of a simplified mesh closer to the original surface. Takes
/// Gauss-Newton steps on sample points of both surfaces, each with its closest point on the other. A vertex
/// is not moved, or moved back to its initial position, if
/// * the cosine between the initial and the new normal of a face would fall below `min_normal_cosine`, or a
///   face would fold or shrink,
/// * a point near it would become almost as distant as the most distant point was initially, or
/// * the normal deviation around it would increase by more than the distances decrease.
/// If the maximum distance has increased after these steps, all vertices keep their initial positions.
/// Afterwards only the vertices around the most distant points are moved, as long as the maximum distance
/// decreases by more than the other deviations increase. Then edges are flipped where that brings the surfaces
/// closer, and further steps are taken.
/// \param original           finite, scaled to a bounding box diagonal of about 1
/// \param simplified         finite, in the same units
/// \param fixed              one per vertex of `simplified`; nonzero: the vertex does not move. Boundary
///                           vertices do not move either.
/// \param min_normal_cosine  minimum cosine between the initial and the new normal of a face, in [-1, 1]
/// \param flips              whether edges are flipped once
/// \param groups             one per triangle of `simplified`, or empty; edges between groups are not flipped
/// \param context            the result does not depend on the number of threads
/// O(points log faces) per step, with ten points per face of `simplified` (at least 5000, at most 2,000,000)
/// and twice as many on the original
FittingResult fit_vertices(const MeshRef& original, const MeshRef& simplified,
                           std::span<const std::uint8_t> fixed, double min_normal_cosine, EdgeFlips flips,
                           std::span<const Index> groups, const RunContext& context);

FAQEM_DETAIL_END

#ifdef FAQEM_HEADER_ONLY
#include "faqem/detail/fitting/vertex_fitting-inl.hpp"
#endif
