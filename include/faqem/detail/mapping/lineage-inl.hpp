#pragma once

#include "faqem/detail/mapping/lineage.hpp"
#include "faqem/export.hpp"

#include "faqem/engine/mesh/vector.hpp"

FAQEM_NAMESPACE_BEGIN
namespace detail {

using engine::to_eigen;
using engine::Vector3;

FAQEM_INLINE LineageMap::LineageMap(const CollapseHistory& history)
    : history_(history), replay_(replay_vertices(history)), first_face_(history.positions.size() + 1, 0) {
    for (const Triangle& t : history.triangles) {
        if (t[0] == no_index) continue;
        for (Index v : t) ++first_face_[v + std::size_t{1}];
    }
    for (std::size_t v = 0; v < history.positions.size(); ++v) first_face_[v + 1] += first_face_[v];
    faces_.resize(first_face_.back());
    std::vector<std::uint64_t> next(first_face_.begin(), first_face_.end() - 1);
    for (std::size_t f = 0; f < history.triangles.size(); ++f) {
        if (history.triangles[f][0] == no_index) continue;
        for (Index v : history.triangles[f]) faces_[next[v]++] = static_cast<Index>(f);
    }
}

FAQEM_INLINE SurfacePoint LineageMap::map(Index face, const Vec3& barycentric) const {
    const Triangle& corners = replay_.kept_corners[face];
    const Vector3 p0 = replay_.position_on(face, barycentric);
    const auto distance = [&](Index v) { return (to_eigen(replay_.positions[v]) - p0).squaredNorm(); };

    Index at = corners[0];
    for (Index v : {corners[1], corners[2]}) {
        if (distance(v) < distance(at)) at = v;
    }
    while (at >= history_.positions.size()) {
        const Collapse& c = history_.collapses[at - history_.positions.size()];
        at = distance(c.second) < distance(c.first) ? c.second : c.first;
    }
    const Index was = history_.kept_faces[face];
    Index best = no_index;
    for (std::uint64_t i = first_face_[at]; i < first_face_[at + std::size_t{1}]; ++i) {
        const bool ours =
            history_.face_groups.empty() || history_.face_groups[faces_[i]] == history_.face_groups[was];
        if (best == no_index || ours) best = faces_[i];
        if (ours) break;
    }
    if (best == no_index) return {was, barycentric, MapStep::closest};
    const Triangle& t = history_.triangles[best];
    return {best, {t[0] == at ? 1.0 : 0.0, t[1] == at ? 1.0 : 0.0, t[2] == at ? 1.0 : 0.0}, MapStep::history};
}

}  // namespace detail
FAQEM_NAMESPACE_END
