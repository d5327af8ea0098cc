#pragma once
/// \file
/// Moves the vertices of a light mesh, whose connectivity stays, closer to the original surface.

#include <cstdint>
#include <span>
#include <vector>

#include "faqem/export.hpp"
#include "faqem/detail/fitting/edge_flip_search.hpp"

FAQEM_NAMESPACE_BEGIN
namespace detail {

/// Fits the light mesh to the original: Gauss-Newton steps on points spread over both, each with its closest
/// point on the other. A vertex stays, or goes back, where a face would turn by more than the flip veto
/// allows, where a point would be nearly as far away as the farthest was before, and where the normals lose
/// more than the distances gain; if the farthest is farther in the end, nothing moves. Then the vertices
/// around the farthest points move on, as long as these come nearer for less than the rest loses.
/// \param original    finite
/// \param light       finite, in the same units
/// \param fixed       one per vertex of light: nonzero must not move. Open borders do not move either.
/// \param least_turn  cosine between old and new normal of a face, at least
/// \param workers     the result does not depend on how many
/// \return the positions of all vertices of light
/// Complexity: O(points log faces) a step; ten points per face of the light mesh on it, twice as many on the
/// original.
std::vector<engine::Vector3> relax(const Patchwork& original, const Patchwork& light,
                                   std::span<const std::uint8_t> fixed, double least_turn, Workers workers);

/// What relax_and_swap() did.
struct Relaxed {
    std::vector<engine::Vector3> positions;  ///< of all vertices of light
    std::vector<EdgeSwap> swaps;             ///< in the order in which they were made
};

/// relax(), with edges swapped twice before the farthest points are drawn in: where that brings the surfaces
/// closer, and each time with more steps after it.
/// \param groups  of the triangles of light, or empty: edges between groups are not swapped
/// The other parameters are those of relax().
/// Complexity: that of relax(), about twice over.
Relaxed relax_and_swap(const Patchwork& original, const Patchwork& light, std::span<const std::uint8_t> fixed,
                       std::span<const Index> groups, double least_turn, Workers workers);

}  // namespace detail
FAQEM_NAMESPACE_END

#ifdef FAQEM_HEADER_ONLY
#include "faqem/detail/fitting/vertex_fitting-inl.hpp"
#endif
