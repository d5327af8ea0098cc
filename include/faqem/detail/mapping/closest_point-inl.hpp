#pragma once

#include "faqem/detail/mapping/closest_point.hpp"
#include "faqem/export.hpp"

#include "faqem/engine/mesh/vector.hpp"

FAQEM_NAMESPACE_BEGIN
namespace detail {

using engine::to_eigen;

FAQEM_INLINE ClosestPointMap::ClosestPointMap(const CollapseHistory& history,
                                              const engine::RunContext& context)
    : history_(history),
      replay_(replay_vertices(history)),
      tree_(history.positions, history.triangles, context) {}

FAQEM_INLINE SurfacePoint ClosestPointMap::to_surface_point(const Bvh::Hit& hit, Index face,
                                                            const Vec3& barycentric) const {
    if (hit.face == no_index) return {history_.kept_faces[face], barycentric, MapStep::closest};
    return {hit.face, hit.barycentric, MapStep::closest};
}

FAQEM_INLINE SurfacePoint ClosestPointMap::map(Index face, const Vec3& barycentric) const {
    return to_surface_point(tree_.closest(engine::to_array(replay_.position_on(face, barycentric))), face,
                            barycentric);
}

FAQEM_INLINE SurfacePoint ClosestPointMap::map_near(Index face, const Vec3& barycentric,
                                                    const SurfacePoint& near) const {
    const Triangle& t = history_.triangles[near.face];
    if (t[0] == no_index) return map(face, barycentric);
    const auto& positions = history_.positions;
    return to_surface_point(tree_.closest_with_hint(engine::to_array(replay_.position_on(face, barycentric)),
                                                    near.face, to_eigen(positions[t[0]]),
                                                    to_eigen(positions[t[1]]), to_eigen(positions[t[2]])),
                            face, barycentric);
}

}  // namespace detail
FAQEM_NAMESPACE_END
