#pragma once
/// \file
/// Vertex-to-face adjacency of a mesh whose connectivity does not change.

#include <cstddef>
#include <span>

#include "faqem/detail/base/buckets.hpp"
#include "faqem/export.hpp"
#include "faqem/mesh.hpp"

FAQEM_DETAIL_BEGIN

/// For each vertex the indices of its faces, in increasing order.
using VertexFaces = Buckets<Index>;

/// Lists the faces of each vertex.
/// \param vertices   number of vertices
/// \param triangles  vertex indices < vertices; triangles with no_index as first corner are skipped
/// O(vertices + faces)
inline VertexFaces make_vertex_faces(std::size_t vertices, std::span<const Triangle> triangles) {
    return VertexFaces(vertices, [&](auto&& put) {
        for (Index f = 0; f < triangles.size(); ++f) {
            if (triangles[f][0] == no_index) continue;
            for (const Index v : triangles[f]) put(v, f);
        }
    });
}

FAQEM_DETAIL_END
