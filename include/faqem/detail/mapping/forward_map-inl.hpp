#pragma once

#include "faqem/forward_map.hpp"

#include <array>
#include <cassert>
#include <limits>
#include <tuple>

#include "faqem/detail/base/vector.hpp"
#include "faqem/detail/geometry/triangle.hpp"
#include "faqem/detail/geometry/vertex_faces.hpp"
#include "faqem/detail/history/final_versions.hpp"

FAQEM_NAMESPACE_BEGIN

FAQEM_INLINE std::vector<Index> vertex_map(const CollapseHistory& history) {
    const std::vector<Index> last = detail::final_versions(history);
    std::vector<Index> number(last.size(), no_index);
    for (Index v = 0; v < history.remaining_versions.size(); ++v) number[history.remaining_versions[v]] = v;
    std::vector<Index> vertex;
    vertex.reserve(history.positions.size());
    for (std::size_t v = 0; v < history.positions.size(); ++v) vertex.push_back(number[last[v]]);
    return vertex;
}

struct ForwardMap::Impl {
    // The best point found so far.
    struct Best {
        Index face = no_index;
        bool is_opposite = true;
        double distance_squared = std::numeric_limits<double>::infinity();
        engine::Vector3 barycentric = engine::Vector3::Zero();
    };

    explicit Impl(const CollapseHistory& h)
        : history(h),
          simplified(replay(h)),
          vertex(vertex_map(h)),
          vertex_faces(detail::make_vertex_faces(simplified.positions.size(), simplified.triangles)) {}

    engine::Vector3 corner(Index face, std::size_t k) const {
        return engine::to_eigen(simplified.positions[simplified.triangles[face][k]]);
    }

    // Searches the one-ring of vertex v for a better point. A face with opposite normal is on the other side
    // of a thin wall and is taken only if there is no other. Among equally close faces, the one with the
    // smallest index is taken, so that the result does not depend on the order of the search.
    void search_vertex_faces(Index v, const engine::Vector3& p, const engine::Vector3& normal,
                             Best& best) const {
        for (const Index f : vertex_faces[v]) {
            const engine::Vector3 a = corner(f, 0), b = corner(f, 1), c = corner(f, 2);
            const engine::Vector3 own = engine::area_vector(a, b, c);
            const bool is_opposite = own.dot(normal) < -0.5 * own.norm();
            const detail::ClosestPoint at = detail::closest_point_on_triangle(p, a, b, c);
            if (std::tie(is_opposite, at.distance_squared, f) <
                std::tie(best.is_opposite, best.distance_squared, best.face))
                best = {f, is_opposite, at.distance_squared, at.barycentric};
        }
    }

    const CollapseHistory& history;
    TriangleMesh simplified;
    std::vector<Index> vertex;
    detail::VertexFaces vertex_faces;
};

FAQEM_INLINE ForwardMap::ForwardMap(const CollapseHistory& history)
    : impl_(std::make_unique<const Impl>(history)) {}
FAQEM_INLINE ForwardMap::~ForwardMap() = default;
FAQEM_INLINE ForwardMap::ForwardMap(ForwardMap&&) noexcept = default;
FAQEM_INLINE ForwardMap& ForwardMap::operator=(ForwardMap&&) noexcept = default;

FAQEM_INLINE SimplifiedPoint ForwardMap::map(Index face, const Vec3& barycentric) const {
    assert(face < impl_->history.triangles.size());
    const Triangle& corners = impl_->history.triangles[face];
    if (corners[0] == no_index) return {};
    std::array<engine::Vector3, 3> at;
    for (std::size_t k = 0; k < 3; ++k) at[k] = engine::to_eigen(impl_->history.positions[corners[k]]);
    const engine::Vector3 p = barycentric[0] * at[0] + barycentric[1] * at[1] + barycentric[2] * at[2];
    // Zero for a face of zero area.
    const engine::Vector3 normal = engine::area_vector(at[0], at[1], at[2]).normalized();
    Impl::Best best;
    for (const Index v : corners)
        if (impl_->vertex[v] != no_index) impl_->search_vertex_faces(impl_->vertex[v], p, normal, best);
    Index from = no_index;
    while (best.face != from) {
        from = best.face;
        for (const Index v : impl_->simplified.triangles[from])
            impl_->search_vertex_faces(v, p, normal, best);
    }
    if (best.face == no_index) return {};
    return {best.face, engine::to_array(best.barycentric)};
}

FAQEM_NAMESPACE_END
