#pragma once
/// \file
/// Map from the simplified mesh to the original by closest points, as for texture baking without a history.

#include "faqem/detail/geometry/bvh.hpp"
#include "faqem/detail/mapping/replay.hpp"
#include "faqem/engine/util/run_context.hpp"
#include "faqem/export.hpp"
#include "faqem/history.hpp"
#include "faqem/surface_map.hpp"

FAQEM_NAMESPACE_BEGIN
namespace detail {

/// Maps a point to the closest point of the whole original, regardless of normals, surface patches and
/// groups. On thin walls the result is often on the wrong side.
class ClosestPointMap {
public:
    /// \param history  valid; must outlive this object
    /// \throws whatever `context` throws
    /// O(n log n) in the faces of the original, plus O(size of the history)
    explicit ClosestPointMap(const CollapseHistory& history, const engine::RunContext& context = {});

    /// Maps one point. If several faces are equally close, the result is the one with the smallest index.
    /// \param face         face of the simplified mesh
    /// \param barycentric  weights of its three corners, >= 0, sum 1
    /// O(log faces) typically
    SurfacePoint map(Index face, const Vec3& barycentric) const;

    /// Same result as map(), faster: the result `near` for a nearby point bounds the distance.
    SurfacePoint map_near(Index face, const Vec3& barycentric, const SurfacePoint& near) const;

private:
    SurfacePoint to_surface_point(const Bvh::Hit& hit, Index face, const Vec3& barycentric) const;

    const CollapseHistory& history_;
    ReplayTables replay_;
    Bvh tree_;
};

}  // namespace detail
FAQEM_NAMESPACE_END

#ifdef FAQEM_HEADER_ONLY
#include "faqem/detail/mapping/closest_point-inl.hpp"
#endif
