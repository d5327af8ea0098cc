#pragma once
/// \file
/// Which edges of a light mesh should be swapped to come closer to the original.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "faqem/export.hpp"
#include "faqem/detail/fitting/closest_point_tracker.hpp"

FAQEM_NAMESPACE_BEGIN
namespace detail {

/// A light mesh on its way to the original. Borrows.
struct LightMesh {
    std::span<const engine::Vector3> positions;
    std::span<const Triangle> triangles;  ///< a triangle with no_index corners is none
    std::span<const std::uint8_t> fixed;  ///< per vertex: an edge between two that are not zero stays
    std::span<const Index> groups;        ///< per triangle, or empty: edges between groups stay
};

/// Two faces whose common edge is to be swapped.
using EdgeSwap = std::array<Index, 2>;

/// Finds edges whose swap brings both surfaces closer: less of the integral of d^2.5 over points on both, no
/// farther point, no larger loss in the normals, no slivers, no folds, no edge twice. An edge has two faces
/// of the same winding. No two of them touch each other, so that all may be swapped.
///
/// \param light     is swapped as it is now
/// \param original  the surface it should be close to
/// \param even      points spread evenly over the original, measured where light is now
/// \param corners   the original's vertices, measured likewise: only the farthest counts
/// \param area      of the original
/// \param workers   the result does not depend on their number
/// \return in order of what they gain
/// \throws what the poll of the workers throws
/// O(n log n). Source: Hoppe et al. 1993, Mesh Optimization (the operation)
std::vector<EdgeSwap> better_edges(const LightMesh& light, const StillSurface& original, const GapsBack& even,
                                   const GapsBack& corners, double area, Workers workers);

}  // namespace detail
FAQEM_NAMESPACE_END

#ifdef FAQEM_HEADER_ONLY
#include "faqem/detail/fitting/edge_flip_search-inl.hpp"
#endif
