#pragma once
/// \file
/// The faces around each vertex of a mesh that stays as it is.

#include <cstddef>
#include <span>

#include "faqem/detail/base/bucketed.hpp"
#include "faqem/engine/util/cancellation.hpp"
#include "faqem/export.hpp"
#include "faqem/mesh.hpp"

FAQEM_NAMESPACE_BEGIN
namespace detail {

/// The faces around each vertex, in their order.
using VertexFaces = Buckets<Index>;

/// \param vertices   their number
/// \param triangles  a triangle with no_index corners is none
/// \throws what the poll throws
/// O(vertices + faces)
inline VertexFaces make_vertex_faces(std::size_t vertices, std::span<const Triangle> triangles,
                                     engine::CancellationCheck check_cancelled = {}) {
    return VertexFaces(vertices, [&](auto&& put) {
        for (Index f = 0; f < triangles.size(); ++f) {
            check_cancelled();
            if (triangles[f][0] == no_index) continue;
            for (const Index v : triangles[f]) put(v, f);
        }
    });
}

}  // namespace detail
FAQEM_NAMESPACE_END
