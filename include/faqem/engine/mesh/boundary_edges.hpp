#pragma once
/// \file
/// Boundary edges of a mesh, and those that a collapse would leave.

#include <algorithm>
#include <array>
#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

#include "faqem/engine/mesh/collapse_mesh.hpp"
#include "faqem/engine/mesh/pair_table.hpp"
#include "faqem/export.hpp"

FAQEM_ENGINE_BEGIN

/// A boundary edge at the new vertex of a pair (u, v), as it will be after the collapse.
struct BoundaryEdge {
    Index vertex;                  ///< the other end
    std::uint32_t with_u, with_v;  ///< current face counts of the edges (u, vertex) and (v, vertex)
};

namespace boundary_edges {

// Number of faces of the edge (v, other); 0 if there is no such edge. O(smaller valence)
inline std::uint32_t edge_face_count(const CollapseMesh& mesh, const PairTable& pairs, Index v, Index other) {
    std::uint32_t count = 0;
    const auto [lower, higher] = mesh.lower_degree_first(v, other);
    pairs.for_each_pair(lower, [&, end = higher](Neighbour n) {
        if (n.vertex == end) count = pairs.face_count(n.pair);
    });
    return count;
}

}  // namespace boundary_edges

/// Calls visit(a, b, up, down) for each edge in lexicographic order, a < b, where `up` faces pass it from a to b
/// and `down` faces from b to a. O(triangles) for bounded valence; 12 bytes of temporary memory per triangle
/// \param triangles        with pairwise different corners
/// \param vertices         number of vertices; larger than any corner, below 2^31
template <class Visit>
void for_each_edge(std::span<const Triangle> triangles, std::size_t vertices, Visit&& visit) {
    std::vector<std::size_t> offsets(vertices + 1, 0);
    const auto for_each_side = [&](auto&& visit_side) {
        for (const Triangle& t : triangles) {
            for (std::size_t k = 0; k < 3; ++k) {
                const Index a = t[k], b = t[(k + 1) % 3];
                visit_side(std::min(a, b), 2 * std::max(a, b) + (a < b ? 0 : 1));
            }
        }
    };
    for_each_side([&](Index a, Index) { ++offsets[a + 1]; });
    std::partial_sum(offsets.begin(), offsets.end(), offsets.begin());
    // Twice the larger end, plus 1 for the direction to the smaller one.
    std::vector<Index> larger(offsets.back());
    for_each_side([&](Index a, Index side) { larger[offsets[a]++] = side; });
    std::size_t begin = 0;
    for (Index a = 0; a < vertices; ++a) {  // offsets[a] is now the end of the edges of a
        const std::size_t end = offsets[a];
        std::sort(larger.begin() + static_cast<std::ptrdiff_t>(begin),
                  larger.begin() + static_cast<std::ptrdiff_t>(end));
        for (std::size_t i = begin; i < end;) {
            std::array<std::uint32_t, 2> faces = {};
            const Index b = larger[i] / 2;
            for (; i < end && larger[i] / 2 == b; ++i) ++faces[larger[i] % 2];
            visit(a, b, faces[0], faces[1]);
        }
        begin = end;
    }
}

/// Finds the boundary edges, which have exactly one face. Complexity and parameters: as for_each_edge()
/// \return the edges, each with its smaller end first, in lexicographic order
inline std::vector<std::array<Index, 2>> find_boundary_edges(std::span<const Triangle> triangles,
                                                             std::size_t vertices) {
    std::vector<std::array<Index, 2>> open;
    for_each_edge(triangles, vertices, [&](Index a, Index b, std::uint32_t up, std::uint32_t down) {
        if (up + down == 1) open.push_back({a, b});
    });
    return open;
}

/// Calls visit(BoundaryEdge) for each boundary edge from a neighbour of u to the new vertex of the pair (u, v) after its
/// collapse. O(valence squared)
template <class Visit>
void for_each_boundary_edge_after_at(const CollapseMesh& mesh, const PairTable& pairs, Index u, Index v,
                                     Visit&& visit) {
    using namespace boundary_edges;
    pairs.for_each_pair(u, [&](Neighbour n) {
        const std::uint32_t with_u = pairs.face_count(n.pair);
        if (n.vertex == v || with_u == 0) return;
        const std::uint32_t with_v = edge_face_count(mesh, pairs, v, n.vertex);
        const std::uint32_t removed = with_v > 0 ? 2 * mesh.count_faces_with(u, v, n.vertex) : 0;
        if (with_u + with_v - removed == 1) visit(BoundaryEdge{n.vertex, with_u, with_v});
    });
}

/// Calls visit(BoundaryEdge) for each boundary edge that the new vertex of a pair would have after the
/// collapse. O(valence squared)
template <class Visit>
void for_each_boundary_edge_after(const CollapseMesh& mesh, const PairTable& pairs, Index u, Index v,
                                  Visit&& visit) {
    using namespace boundary_edges;
    for_each_boundary_edge_after_at(mesh, pairs, u, v, visit);
    pairs.for_each_pair(v, [&](Neighbour n) {
        if (n.vertex == u || pairs.face_count(n.pair) != 1) return;
        if (edge_face_count(mesh, pairs, u, n.vertex) == 0) visit(BoundaryEdge{n.vertex, 0, 1});
    });
}

FAQEM_ENGINE_END
