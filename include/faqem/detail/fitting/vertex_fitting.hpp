#pragma once
/// \file
/// Moves the vertices of a simplified mesh, whose connectivity stays, closer to the original surface.

#include <cstdint>
#include <span>
#include <vector>

#include "faqem/detail/fitting/edge_flip_search.hpp"
#include "faqem/export.hpp"

FAQEM_NAMESPACE_BEGIN
namespace detail {

/// Fits the simplified mesh to the original: Gauss-Newton steps on points spread over both, each with its closest
/// point on the other. A vertex stays, or goes back, where a face would turn by more than the flip veto
/// allows, where a point would be nearly as far away as the farthest was before, and where the normals lose
/// more than the distances gain; if the farthest is farther in the end, nothing moves. Then the vertices
/// around the farthest points move on, as long as these come nearer for less than the rest loses.
/// \param original    finite
/// \param simplified       finite, in the same units
/// \param fixed       one per vertex of simplified: nonzero must not move. Open borders do not move either.
/// \param min_normal_cosine  cosine between old and new normal of a face, at least
/// \param workers     the result does not depend on how many
/// \return the positions of all vertices of simplified
/// Complexity: O(points log faces) a step; ten points per face of the simplified mesh on it, twice as many on the
/// original.
std::vector<engine::Vector3> fit_vertices(const MeshRef& original, const MeshRef& simplified,
                                          std::span<const std::uint8_t> fixed, double min_normal_cosine,
                                          Workers workers);

/// What fit_vertices_and_flip_edges() did.
struct FittingResult {
    std::vector<engine::Vector3> positions;  ///< of all vertices of simplified
    std::vector<EdgeFlip> flips;             ///< in the order in which they were made
};

/// fit_vertices(), with edges flipped twice before the farthest points are drawn in: where that brings the surfaces
/// closer, and each time with more steps after it.
/// \param groups  of the triangles of simplified, or empty: edges between groups are not flipped
/// The other parameters are those of fit_vertices().
/// Complexity: that of fit_vertices(), about twice over.
FittingResult fit_vertices_and_flip_edges(const MeshRef& original, const MeshRef& simplified,
                                          std::span<const std::uint8_t> fixed, std::span<const Index> groups,
                                          double min_normal_cosine, Workers workers);

}  // namespace detail
FAQEM_NAMESPACE_END

#ifdef FAQEM_HEADER_ONLY
#include "faqem/detail/fitting/vertex_fitting-inl.hpp"
#endif
