#pragma once
/// \file
/// Which edges of a simplified mesh should be flipped to come closer to the original.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "faqem/detail/fitting/closest_point_tracker.hpp"
#include "faqem/export.hpp"

FAQEM_NAMESPACE_BEGIN
namespace detail {

/// A simplified mesh on its way to the original. Borrows.
struct SimplifiedMeshRef {
    std::span<const engine::Vector3> positions;
    std::span<const Triangle> triangles;  ///< a triangle with no_index corners is none
    std::span<const std::uint8_t> fixed;  ///< per vertex: an edge between two that are not zero stays
    std::span<const Index> groups;        ///< per triangle, or empty: edges between groups stay
};

/// Two faces whose common edge is to be flipped.
using EdgeFlip = std::array<Index, 2>;

/// Finds edges whose flip brings both surfaces closer: less of the integral of d^2.5 over points on both, no
/// farther point, no larger loss in the normals, no slivers, no folds, no edge twice. An edge has two faces
/// of the same winding. No two of them touch each other, so that all may be flipped.
///
/// \param simplified     is flipped as it is now
/// \param original  the surface it should be close to
/// \param even_samples      points spread evenly over the original, measured where simplified is now
/// \param original_vertices   the original's vertices, measured likewise: only the farthest counts
/// \param area      of the original
/// \param workers   the result does not depend on their number
/// \return in order of what they gain
/// \throws what the poll of the workers throws
/// O(n log n). Source: Hoppe et al. 1993, Mesh Optimization (the operation)
std::vector<EdgeFlip> find_edge_flips(const SimplifiedMeshRef& simplified, const ReferenceSurface& original,
                                      const ReferenceToMeshTracker& even_samples,
                                      const ReferenceToMeshTracker& original_vertices, double area,
                                      Workers workers);

}  // namespace detail
FAQEM_NAMESPACE_END

#ifdef FAQEM_HEADER_ONLY
#include "faqem/detail/fitting/edge_flip_search-inl.hpp"
#endif
