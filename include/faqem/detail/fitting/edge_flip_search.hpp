#pragma once
/// \file
/// Search for edge flips that bring a simplified mesh closer to the original surface.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "faqem/detail/fitting/closest_point_tracker.hpp"
#include "faqem/export.hpp"

FAQEM_DETAIL_BEGIN

/// Non-owning view of a simplified mesh and its constraints.
struct SimplifiedMeshRef {
    std::span<const Vector3> positions;
    std::span<const Triangle> triangles;  ///< triangles with no_index corners are ignored
    std::span<const std::uint8_t> fixed;  ///< per vertex; edges between two nonzero vertices are not flipped
    std::span<const Index> groups;        ///< per triangle, or empty; edges between groups are not flipped
};

/// The two faces whose common edge is to be flipped.
using EdgeFlip = std::array<Index, 2>;

/// Finds edge flips that bring both surfaces closer. With the distance d, a flip must decrease the integral
/// of d^2.5 over points on both surfaces by at least 2%. It may increase the maximum distance only where that
/// is well below the overall maximum, and the normal deviation only by a smaller factor than it decreases the
/// integral. It must not create slivers, folds or duplicate edges. Only edges with exactly two faces of
/// consistent orientation are flipped. The returned flips are independent: no two of them have a face or an
/// edge of their quadrilaterals in common, so that all may be applied.
///
/// \param simplified         the mesh in its current state; not modified
/// \param original           the surface it should be close to
/// \param even_samples       uniform samples of the original, with residuals to the current mesh
/// \param original_vertices  the vertices of the original, likewise; used for the maximum distance only
/// \param area               surface area of the original
/// \param context            the result does not depend on the number of threads
/// \return the flips, in order of decreasing gain
/// O(n log n). Source of the operation: Hoppe et al. 1993, Mesh Optimization
std::vector<EdgeFlip> find_edge_flips(const SimplifiedMeshRef& simplified, const ReferenceSurface& original,
                                      const ReferenceToMeshTracker& even_samples,
                                      const ReferenceToMeshTracker& original_vertices, double area,
                                      const RunContext& context);

FAQEM_DETAIL_END

#ifdef FAQEM_HEADER_ONLY
#include "faqem/detail/fitting/edge_flip_search-inl.hpp"
#endif
