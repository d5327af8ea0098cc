#pragma once

#include "faqem/export.hpp"
#include "faqem/surface_map.hpp"

#include "faqem/detail/mapping/closest_point.hpp"
#include "faqem/detail/mapping/lineage.hpp"
#include "faqem/detail/mapping/successive_projection.hpp"

FAQEM_NAMESPACE_BEGIN

struct SurfaceMap::Impl {
    // Exactly one of these is set.
    std::unique_ptr<const detail::SuccessiveProjection> projection;
    std::unique_ptr<const detail::LineageMap> lineage;
    std::unique_ptr<const detail::ClosestPointMap> closest;
};

FAQEM_INLINE SurfaceMap::SurfaceMap(const CollapseHistory& history, Mapping mapping,
                                    std::span<const Triangle> unwelded)
    : SurfaceMap(detail::make_surface_map(history, mapping, unwelded, {})) {}

FAQEM_INLINE SurfaceMap::SurfaceMap(std::unique_ptr<const Impl> impl) : impl_(std::move(impl)) {}

FAQEM_INLINE SurfaceMap detail::make_surface_map(const CollapseHistory& history, Mapping mapping,
                                                 std::span<const Triangle> unwelded, const Workers& workers) {
    auto impl = std::make_unique<SurfaceMap::Impl>();
    switch (mapping) {
        case Mapping::projection:
            impl->projection =
                std::make_unique<const detail::SuccessiveProjection>(history, unwelded, workers);
            break;
        case Mapping::lineage:
            impl->lineage = std::make_unique<const detail::LineageMap>(history, workers.check_cancelled);
            break;
        case Mapping::closest:
            impl->closest = std::make_unique<const detail::ClosestPointMap>(history, workers.check_cancelled);
            break;
    }
    return SurfaceMap(std::move(impl));
}

FAQEM_INLINE SurfaceMap::~SurfaceMap() = default;
FAQEM_INLINE SurfaceMap::SurfaceMap(SurfaceMap&&) noexcept = default;
FAQEM_INLINE SurfaceMap& SurfaceMap::operator=(SurfaceMap&&) noexcept = default;

FAQEM_INLINE SurfacePoint SurfaceMap::map(Index face, const Vec3& barycentric) const {
    if (impl_->projection) return impl_->projection->map(face, barycentric);
    return impl_->lineage ? impl_->lineage->map(face, barycentric) : impl_->closest->map(face, barycentric);
}

FAQEM_INLINE SurfacePoint SurfaceMap::map_near(Index face, const Vec3& barycentric,
                                               const SurfacePoint& near) const {
    if (impl_->projection) return impl_->projection->map_near(face, barycentric, near);
    return impl_->lineage ? impl_->lineage->map(face, barycentric)
                          : impl_->closest->map_near(face, barycentric, near);
}

FAQEM_NAMESPACE_END
