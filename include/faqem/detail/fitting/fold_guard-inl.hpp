#pragma once

#include "faqem/detail/fitting/fold_guard.hpp"
#include "faqem/export.hpp"

#include "faqem/detail/geometry/halfedges.hpp"

FAQEM_NAMESPACE_BEGIN
namespace detail {

FAQEM_INLINE FoldGuard::FoldGuard(const MeshRef& mesh, double min_fold_cosine)
    : triangles_(mesh.triangles), min_fold_cosine_(min_fold_cosine) {
    const std::vector<engine::Vector3> normals = unit_normals(mesh);
    for_each_edge(sorted_halfedges(triangles_), [&](std::span<const Halfedge> on) {
        if (on.size() != 2) return;
        const Edge edge{{on[0].face, on[1].face}, on[0].is_ascending == on[1].is_ascending};
        if (!is_fold(edge, normals)) edges_.push_back(edge);
    });
}

}  // namespace detail
FAQEM_NAMESPACE_END
