#include "faqem/surface_map.hpp"

#include "mapping_lineage.hpp"
#include "mapping_projection.hpp"

namespace faqem {

struct SurfaceMap::Impl {
    std::unique_ptr<const detail::ProjectionWalk> projection;  // one of the two
    std::unique_ptr<const detail::LineageWalk> lineage;
};

SurfaceMap::SurfaceMap(const CollapseHistory& history, Mapping mapping) {
    auto impl = std::make_unique<Impl>();
    if (mapping == Mapping::projection) {
        impl->projection = std::make_unique<const detail::ProjectionWalk>(history);
    } else {
        impl->lineage = std::make_unique<const detail::LineageWalk>(history);
    }
    impl_ = std::move(impl);
}

SurfaceMap::~SurfaceMap() = default;
SurfaceMap::SurfaceMap(SurfaceMap&&) noexcept = default;
SurfaceMap& SurfaceMap::operator=(SurfaceMap&&) noexcept = default;

SurfacePoint SurfaceMap::map(Index face, const Vec3& barycentric) const {
    return impl_->projection ? impl_->projection->map(face, barycentric)
                             : impl_->lineage->map(face, barycentric);
}

SurfacePoint SurfaceMap::map_near(Index face, const Vec3& barycentric, const SurfacePoint& near) const {
    return impl_->projection ? impl_->projection->map_near(face, barycentric, near)
                             : impl_->lineage->map(face, barycentric);
}

}  // namespace faqem
