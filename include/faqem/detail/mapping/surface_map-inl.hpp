#pragma once

#include "faqem/surface_map.hpp"

#include "faqem/detail/mapping/successive_projection.hpp"

FAQEM_NAMESPACE_BEGIN

struct SurfaceMap::Impl : detail::SuccessiveProjection {
    using SuccessiveProjection::SuccessiveProjection;
};

FAQEM_INLINE SurfaceMap::SurfaceMap(const CollapseHistory& history, std::span<const Triangle> unwelded)
    : SurfaceMap(detail::make_surface_map(history, unwelded, {})) {}

FAQEM_INLINE SurfaceMap::SurfaceMap(std::unique_ptr<const Impl> impl) : impl_(std::move(impl)) {}

FAQEM_INLINE SurfaceMap detail::make_surface_map(const CollapseHistory& history,
                                                 std::span<const Triangle> unwelded,
                                                 const RunContext& context) {
    return SurfaceMap(std::make_unique<const SurfaceMap::Impl>(history, unwelded, context));
}

FAQEM_INLINE SurfaceMap::~SurfaceMap() = default;
FAQEM_INLINE SurfaceMap::SurfaceMap(SurfaceMap&&) noexcept = default;
FAQEM_INLINE SurfaceMap& SurfaceMap::operator=(SurfaceMap&&) noexcept = default;

FAQEM_INLINE SurfacePoint SurfaceMap::map(Index face, const Vec3& barycentric) const {
    return impl_->map(face, barycentric);
}

FAQEM_INLINE SurfacePoint SurfaceMap::map_near(Index face, const Vec3& barycentric,
                                               const SurfacePoint& near) const {
    return impl_->map_near(face, barycentric, near);
}

FAQEM_NAMESPACE_END
