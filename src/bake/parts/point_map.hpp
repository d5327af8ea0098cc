#pragma once
/// \file
/// The points of the source that points of a mesh show.

#include <utility>

#include "faqem/surface_map.hpp"

namespace faqem::detail {

/// Finds the points of a part of the source that correspond to points of a mesh. May be used by several threads at once.
class PointMap {
public:
    PointMap() = default;
    PointMap(const PointMap&) = delete;
    PointMap& operator=(const PointMap&) = delete;
    virtual ~PointMap() = default;

    /// As SurfaceMap::map(): the face of the result is never no_index.
    virtual SurfacePoint map(Index face, const Vec3& barycentric) const = 0;

    /// The point that a sample of a texture shows. Its face is no_index if the source has nothing there.
    /// \param near  null, or the result for a nearby point of the same face, from which the search begins
    virtual SurfacePoint find(Index face, const Vec3& barycentric, const SurfacePoint* near) const = 0;

    /// The map of a history, which is faster for many points close to each other (LocalMap); null for other maps.
    virtual const SurfaceMap* of_history() const { return nullptr; }
};

/// The map from a simplified mesh to its original.
class HistoryMap final : public PointMap {
public:
    explicit HistoryMap(SurfaceMap map) : map_(std::move(map)) {}

    SurfacePoint map(Index face, const Vec3& barycentric) const override {
        return map_.map(face, barycentric);
    }
    SurfacePoint find(Index face, const Vec3& barycentric, const SurfacePoint* near) const override {
        return near ? map_.map_near(face, barycentric, *near) : map_.map(face, barycentric);
    }
    const SurfaceMap* of_history() const override { return &map_; }

private:
    SurfaceMap map_;
};

}  // namespace faqem::detail
