#pragma once

#include "faqem/export.hpp"
#include "faqem/surface_map.hpp"

#include <variant>

#include "faqem/detail/mapping/closest_point.hpp"
#include "faqem/detail/mapping/lineage.hpp"
#include "faqem/detail/mapping/successive_projection.hpp"

FAQEM_NAMESPACE_BEGIN

struct SurfaceMap::Impl {
    std::variant<std::unique_ptr<const detail::SuccessiveProjection>,
                 std::unique_ptr<const detail::LineageMap>, std::unique_ptr<const detail::ClosestPointMap>>
        map;
};

FAQEM_INLINE SurfaceMap::SurfaceMap(const CollapseHistory& history, Mapping mapping,
                                    std::span<const Triangle> unwelded)
    : SurfaceMap(detail::make_surface_map(history, mapping, unwelded, {})) {}

FAQEM_INLINE SurfaceMap::SurfaceMap(std::unique_ptr<const Impl> impl) : impl_(std::move(impl)) {}

FAQEM_INLINE SurfaceMap detail::make_surface_map(const CollapseHistory& history, Mapping mapping,
                                                 std::span<const Triangle> unwelded,
                                                 const RunContext& context) {
    auto impl = std::make_unique<SurfaceMap::Impl>();
    switch (mapping) {
        case Mapping::projection:
            impl->map = std::make_unique<const detail::SuccessiveProjection>(history, unwelded, context);
            break;
        case Mapping::lineage:
            impl->map = std::make_unique<const detail::LineageMap>(history);
            break;
        case Mapping::closest:
            impl->map = std::make_unique<const detail::ClosestPointMap>(history, context);
            break;
    }
    return SurfaceMap(std::move(impl));
}

FAQEM_INLINE SurfaceMap::~SurfaceMap() = default;
FAQEM_INLINE SurfaceMap::SurfaceMap(SurfaceMap&&) noexcept = default;
FAQEM_INLINE SurfaceMap& SurfaceMap::operator=(SurfaceMap&&) noexcept = default;

FAQEM_INLINE SurfacePoint SurfaceMap::map(Index face, const Vec3& barycentric) const {
    return std::visit([&](const auto& map) { return map->map(face, barycentric); }, impl_->map);
}

FAQEM_INLINE SurfacePoint SurfaceMap::map_near(Index face, const Vec3& barycentric,
                                               const SurfacePoint& near) const {
    return std::visit([&](const auto& map) { return map->map_near(face, barycentric, near); }, impl_->map);
}

FAQEM_NAMESPACE_END
