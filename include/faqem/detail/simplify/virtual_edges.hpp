#pragma once
/// \file
/// Virtual edges: collapse candidates between parts that come close without touching (paper, supplementary).

#include <span>
#include <utility>
#include <vector>

#include "faqem/engine/mesh/collapse_mesh.hpp"
#include "faqem/export.hpp"

FAQEM_NAMESPACE_BEGIN
namespace detail {

/// For each vertex the few nearest vertices of other components. The paper compares centroids of triangles,
/// which misses close vertices of large ones; vertices are what a collapse joins. Kept are pairs on open
/// borders whose surfaces face the same way and belong to the same group; the shortest ones, at most as many
/// as there are vertices. The paper joins closed parts as well: where they touch, that costs nothing and
/// pinches both, which no later collapse undoes.
/// \param mesh      the surface
/// \param face_groups  empty, or one per face slot
/// \param distance     largest length, engine units, > 0
/// \param min_length        shorter pairs are left out: they would be degenerate (paper: 1e-8 of the diagonal)
/// \return distinct pairs, smaller vertex first, ordered by both
/// \throws what the poll throws
///
/// Complexity: O(n log n) expected.
std::vector<std::pair<Index, Index>> virtual_edges(const engine::CollapseMesh& mesh,
                                                   std::span<const Index> face_groups, double distance,
                                                   double min_length,
                                                   engine::CancellationCheck check_cancelled = {});

}  // namespace detail
FAQEM_NAMESPACE_END

#ifdef FAQEM_HEADER_ONLY
#include "faqem/detail/simplify/virtual_edges-inl.hpp"
#endif
