#pragma once

#include "faqem/detail/mapping/local_map.hpp"

#include "faqem/detail/mapping/surface_map-inl.hpp"

FAQEM_DETAIL_BEGIN

FAQEM_INLINE void LocalMap::prepare(const SurfaceMap& map, Index face, const Vec3& barycentric, double radius,
                                    const SurfacePoint& near) {
    clear();
    map.impl_->find_accepted_faces(face, barycentric, radius, near, faces_);
}

FAQEM_INLINE bool LocalMap::prepare_from(const SurfaceMap& map, Index face, const Vec3& barycentric,
                                         double radius, const LocalMap& larger) {
    clear();
    larger.faces_.narrow(map.impl_->position_on(face, barycentric), radius, faces_);
    return !faces_.empty();
}

FAQEM_INLINE SurfacePoint LocalMap::map_near(const SurfaceMap& map, Index face, const Vec3& barycentric,
                                             const SurfacePoint& near) {
    if (faces_.empty()) return map.map_near(face, barycentric, near);
    return map.impl_->map_near(face, barycentric, near, faces_, recent_);
}

FAQEM_INLINE std::optional<SurfacePoint> LocalMap::map_to_same(const SurfaceMap& map, Index face,
                                                               const Vec3& barycentric, MapStep step) {
    if (faces_.empty()) return std::nullopt;
    return map.impl_->map_to_same(face, barycentric, step, faces_, recent_);
}

FAQEM_DETAIL_END
