#pragma once
/// \file
/// From the small surface to the original by successive projection through the collapse history.

#include <memory>
#include <mutex>

#include "faqem/engine/vector.hpp"
#include "faqem/history.hpp"
#include "faqem/surface_map.hpp"
#include "mapping_replay.hpp"
#include "mapping_rings.hpp"
#include "mapping_sheets.hpp"

namespace faqem::detail {

/// After Liu et al. 2024 (arXiv 2409.15458), with rules that keep a sample on its side of thin walls.
///
/// The point p0 and the normal n0 of its small face stay fixed. Backwards over the collapses that touched the
/// face at hand, the walk moves to the best face of the patch as it was before:
/// - of the small face's material group, always (the face at hand is one of them);
/// - looking the way n0 does, where any does: s(f0) s(g) N_g . n0 >= 0.17, s: Sheets::sign;
/// - with the least distance from p0, plus 0.3 mean patch edges outside the umbrella of the face at hand,
/// plus
///   one mean patch edge on another sheet than the small face's.
class ProjectionWalk {
public:
    explicit ProjectionWalk(const CollapseHistory& history);

    SurfacePoint map(Index face, const Vec3& barycentric) const;

    /// As map(), but starts at the answer for a sample close by on the same small face and goes from face to
    /// neighbour, under the same rules, while that brings it nearer. Ten times as fast, and as continuous as
    /// the original is. Where the way does not end soon or close, map() answers.
    SurfacePoint map_near(Index face, const Vec3& barycentric, const SurfacePoint& near) const;

private:
    struct Query;
    struct Best;
    struct Patch;

    Query start(Index face, const Vec3& barycentric) const;
    bool faces_away(Index candidate, const engine::Vector3& area_vector, const Query& query) const;
    Best best_of_patch(Index collapse, Index face, const Query& query) const;
    void consider(std::uint64_t entry, Patch& patch) const;
    SurfacePoint closest_descendant(const Query& query) const;
    double distance_to_original(Index face, const engine::Vector3& p) const;
    SurfacePoint on_original(Index face, const engine::Vector3& p0, MapStep step) const;
    bool descend(const Query& query, Index& face) const;
    bool passes(Index original_face, const Query& query) const;
    Index group(Index f) const { return history_.face_groups.empty() ? 0 : history_.face_groups[f]; }

    const CollapseHistory& history_;
    Replay replay_;
    Sheets sheets_;
    FaceRings rings_;

    /// Only made when a walk ends on the wrong side.
    const FaceRings& descendants() const;
    mutable std::once_flag descendants_once_;
    mutable std::unique_ptr<const FaceRings> descendants_;
};

}  // namespace faqem::detail
