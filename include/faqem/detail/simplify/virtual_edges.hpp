#pragma once
/// \file
/// Virtual edges: collapse candidates between connected components that are close but do not touch (paper,
/// supplementary).

#include <span>
#include <utility>
#include <vector>

#include "faqem/engine/mesh/collapse_mesh.hpp"
#include "faqem/export.hpp"

FAQEM_NAMESPACE_BEGIN
namespace detail {

/// Finds pairs of boundary vertices of different components.
///
/// For each boundary vertex the four nearest vertices of other components are examined. A pair is used if
/// both vertices are on a boundary, their mean normals form an angle of less than 90 degrees, and faces at
/// both belong to the same group. If there are more pairs than vertices, the shortest ones are returned.
///
/// Differs from the paper in two ways. The paper compares centroids of triangles, which misses close vertices
/// of large triangles. It also joins closed components: where they touch, such collapses cost nothing and
/// create non-manifold vertices that no later collapse removes.
/// \param mesh         the surface, engine units; read only during the call
/// \param face_groups  empty, or one per face slot
/// \param distance     maximum length, engine units, > 0
/// \param min_length   minimum length, engine units: shorter pairs would be degenerate (paper: 1e-8 of the
///                     diagonal)
/// \return distinct pairs of vertex slots, each with the smaller one first, sorted
/// Complexity: O(n log n) expected
/// Source: FA-QEM, supplementary
std::vector<std::pair<Index, Index>> virtual_edges(const engine::CollapseMesh& mesh,
                                                   std::span<const Index> face_groups, double distance,
                                                   double min_length);

}  // namespace detail
FAQEM_NAMESPACE_END

#ifdef FAQEM_HEADER_ONLY
#include "faqem/detail/simplify/virtual_edges-inl.hpp"
#endif
