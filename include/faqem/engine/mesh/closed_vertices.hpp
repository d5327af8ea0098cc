#pragma once
/// \file
/// Closed components of a mesh.

#include <cstdint>
#include <span>
#include <vector>

#include "faqem/engine/mesh/boundary_edges.hpp"
#include "faqem/engine/mesh/union_find.hpp"
#include "faqem/export.hpp"

FAQEM_NAMESPACE_BEGIN
namespace engine {

/// Finds the vertices of closed components: those in which every edge has two faces of opposite direction.
/// O(triangles) for bounded valence
/// \param triangles  with pairwise different corners
/// \param vertices   number of vertices; larger than any corner
/// \return one per vertex: 1 if it belongs to a closed component
inline std::vector<std::uint8_t> closed_vertices(std::span<const Triangle> triangles, std::size_t vertices) {
    UnionFind component(vertices);
    std::vector<Index> bad;
    for_each_edge(triangles, vertices, [&](Index a, Index b, std::uint32_t up, std::uint32_t down) {
        component.unite(a, b);
        if (up != 1 || down != 1) bad.push_back(a);
    });
    std::vector<std::uint8_t> closed(vertices, 1);
    for (const Index v : bad) closed[component.find(v)] = 0;
    for (Index v = 0; v < vertices; ++v) closed[v] = closed[component.find(v)];  // the root comes first
    return closed;
}

}  // namespace engine
FAQEM_NAMESPACE_END
