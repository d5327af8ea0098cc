#pragma once
/// \file
/// From the small surface to the original by successive projection through the collapse history.

#include <span>
#include <vector>

#include "faqem/detail/base/parallel.hpp"
#include "faqem/detail/geometry/bvh.hpp"
#include "faqem/detail/mapping/replay.hpp"
#include "faqem/detail/mapping/surface_patches.hpp"
#include "faqem/engine/mesh/vector.hpp"
#include "faqem/export.hpp"
#include "faqem/history.hpp"
#include "faqem/surface_map.hpp"

FAQEM_NAMESPACE_BEGIN
namespace detail {

/// After Liu et al. 2024 (arXiv 2409.15458), with rules that keep a sample on its side of thin walls.
///
/// The point p0 and the normal n0 of its small face stay fixed. Backwards over the collapses that touched the
/// face at hand, the walk moves to the best face of the patch as it was before:
/// - of the small face's material group, always (the face at hand is one of them);
/// - looking the way n0 does, where any does: s(f0) s(g) N_g . n0 >= 0.17, s: SurfacePatches::sign;
/// - with the least distance from p0, plus 0.3 mean patch edges outside the patch_component of the face at hand,
/// plus one mean patch edge on another surface_patch than the small face's.
///
/// A face at hand that p0 lies on is kept. Walks that get too long are given up for the closest face of the
/// small face's surface_patch.
///
/// The faces that a walk moves over are those that were there at the time: where they were far from the
/// original, neighbouring samples part ways. So in the end the closest point is taken, of all original faces
/// around the small one that pass the same tests. Where that one is close by and no face is closer that passes,
/// around or not, the walk could not change the answer and is left out.
class SuccessiveProjection {
public:
    /// \param unwelded  as in find_surface_patches()
    /// \throws what the poll throws
    explicit SuccessiveProjection(const CollapseHistory& history, std::span<const Triangle> unwelded = {},
                                  Workers workers = {});

    SurfacePoint map(Index face, const Vec3& barycentric) const;

    /// As map(), but without the walk where it can do without: the answer for a sample close by on the same
    /// small face bounds the distance instead. The same answer, but where the walk would find a face that is
    /// not around the small one and looks another way or is of another surface_patch. Where `near` fails the tests of
    /// surface_patch, group or side, or a closer face passes them that is not around, map() answers.
    SurfacePoint map_near(Index face, const Vec3& barycentric, const SurfacePoint& near) const;

private:
    struct Query;
    struct Best;
    struct Patch;

    Query make_query(Index face, const Vec3& barycentric) const;
    bool is_facing_away(Index candidate, const engine::Vector3& area_vector, const Query& query) const;
    Best best_of_patch(Index collapse, Index face, const Query& query, std::uint64_t& visited) const;
    void consider(std::uint64_t entry, Patch& patch) const;
    Best walk(Index face, const Query& query) const;
    SurfacePoint map_by_walk(Index face, const Query& query) const;
    SurfacePoint snap_to_closest(const Query& query, Index face, MapStep step) const;
    template <class Filter>
    Bvh::Hit closest_accepted_if(const Query& query, double distance_squared, Filter&& filter) const;
    Bvh::Hit closest_accepted(const Query& query, double distance_squared) const;
    SurfacePoint closest_preimage_face(const Query& query, double distance_squared) const;
    bool is_preimage_face(Index original_face, const Query& query) const;
    ClosestPoint on_original(Index face, const engine::Vector3& p0) const;
    bool is_accepted(Index original_face, const Query& query) const;
    Index group(Index f) const { return history_.face_groups.empty() ? 0 : history_.face_groups[f]; }

    const CollapseHistory& history_;
    Bvh tree_;  // first, and alone: making it takes more for a while than it keeps
    SurfacePatches surface_patches_;
    ReplayTables replay_;
    std::vector<Index> last_;  ///< by version: what became of it in the end
};

}  // namespace detail
FAQEM_NAMESPACE_END

#ifdef FAQEM_HEADER_ONLY
#include "faqem/detail/mapping/successive_projection-inl.hpp"
#endif
