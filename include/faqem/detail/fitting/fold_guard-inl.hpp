#pragma once

#include "faqem/export.hpp"
#include "faqem/detail/fitting/fold_guard.hpp"

#include "faqem/detail/geometry/halfedges.hpp"

FAQEM_NAMESPACE_BEGIN
namespace detail {

FAQEM_INLINE FoldGuard::FoldGuard(const Patchwork& mesh, double least_fold, engine::Poll poll)
    : triangles_(mesh.triangles), least_fold_(least_fold) {
    const std::vector<engine::Vector3> normals = unit_normals(mesh, poll);
    for_each_edge(sorted_sides(triangles_, poll), [&](std::span<const Side> on) {
        poll();
        if (on.size() != 2) return;
        const Edge edge{{on[0].face, on[1].face}, on[0].goes_up == on[1].goes_up};
        if (!is_fold(edge, normals)) edges_.push_back(edge);
    });
}

}  // namespace detail
FAQEM_NAMESPACE_END
