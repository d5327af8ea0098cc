#pragma once
/// \file
/// From the small surface to the original by closest points: what a baker without history does.

#include "faqem/detail/geometry/bvh.hpp"
#include "faqem/detail/mapping/replay.hpp"
#include "faqem/export.hpp"
#include "faqem/history.hpp"
#include "faqem/surface_map.hpp"

FAQEM_NAMESPACE_BEGIN
namespace detail {

/// The closest point of the whole original, with no regard to sides, sheets or groups. On thin walls that is
/// the wrong side as often as not.
class ClosestPointMap {
public:
    /// \throws what the poll throws
    explicit ClosestPointMap(const CollapseHistory& history, engine::CancellationCheck check_cancelled = {});

    /// Of faces at the same distance the one with the smallest index. O(log faces) typically
    SurfacePoint map(Index face, const Vec3& barycentric) const;

    /// The same answer, sooner: `near` bounds the distance.
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
