#pragma once

#include <algorithm>
#include <vector>

#include "faqem/compare.hpp"
#include "faqem/detail/base/vector.hpp"
#include "faqem/detail/geometry/halfedges.hpp"
#include "faqem/engine/mesh/union_find.hpp"
#include "faqem/engine/mesh/weld.hpp"
#include "faqem/error.hpp"
#include "faqem/export.hpp"

FAQEM_NAMESPACE_BEGIN

namespace detail {

/// The faces with three different welded vertices. Stores their number and that of degenerate faces in
/// `result`.
/// \throws InputError  if a vertex index is out of range
inline std::vector<Triangle> welded_faces(const MeshView& mesh, MeshInfo& result) {
    const std::vector<Index> first = engine::weld_exact(mesh.positions);
    std::vector<Triangle> faces;
    faces.reserve(mesh.triangles.size());
    for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
        Triangle t = mesh.triangles[f];
        check_indices(t, f, first.size());
        for (Index& v : t) v = first[v];
        if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0])
            ++result.degenerate_faces;
        else
            faces.push_back(t);
    }
    result.faces = faces.size();
    return faces;
}

/// Returns the number of edges. Stores the numbers of boundary and non-manifold edges in `result`.
inline std::uint64_t count_edges(const std::vector<Triangle>& faces, MeshInfo& result) {
    std::uint64_t count = 0;
    for_each_edge(sorted_halfedges(faces), [&](std::span<const Halfedge> on) {
        ++count;
        result.boundary_edges += on.size() == 1;
        result.nonmanifold_edges += on.size() > 2;
    });
    return count;
}

}  // namespace detail

FAQEM_INLINE MeshInfo info(const MeshView& mesh) {
    MeshInfo result;
    const std::vector<Triangle> faces = detail::welded_faces(mesh, result);
    if (faces.empty()) return result;
    std::vector<bool> used(mesh.positions.size());
    engine::UnionFind joined(used.size());
    const auto position = [&](Index v) { return engine::to_eigen(mesh.positions[v]); };
    engine::Vector3 low = position(faces[0][0]), high = low;
    for (const Triangle& t : faces) {
        for (const Index v : t) {
            used[v] = true;
            joined.unite(t[0], v);
            low = low.cwiseMin(position(v));
            high = high.cwiseMax(position(v));
        }
        result.area += engine::area_vector(position(t[0]), position(t[1]), position(t[2])).norm() / 2;
    }
    result.vertices = static_cast<std::uint64_t>(std::count(used.begin(), used.end(), true));
    const std::uint64_t edges = detail::count_edges(faces, result);
    for (Index v = 0; v < used.size(); ++v) result.components += used[v] && joined.find(v) == v;
    result.euler = static_cast<std::int64_t>(result.vertices) - static_cast<std::int64_t>(edges) +
                   static_cast<std::int64_t>(result.faces);
    result.box_min = engine::to_array(low);
    result.box_max = engine::to_array(high);
    result.diagonal = (high - low).norm();
    return result;
}

FAQEM_NAMESPACE_END
