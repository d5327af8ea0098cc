#pragma once
/// \file
/// Map from the simplified mesh to the original by successive projection along the collapse history.

#include <optional>
#include <span>
#include <vector>

#include "faqem/detail/base/parallel.hpp"
#include "faqem/detail/base/vector.hpp"
#include "faqem/detail/geometry/bvh.hpp"
#include "faqem/detail/geometry/near_triangles.hpp"
#include "faqem/detail/mapping/replay.hpp"
#include "faqem/detail/mapping/surface_patches.hpp"
#include "faqem/export.hpp"
#include "faqem/history.hpp"
#include "faqem/surface_map.hpp"

FAQEM_DETAIL_BEGIN

/// Minimum cosine between the normals of faces that have the same orientation.
inline constexpr double min_facing_cosine = 0.17;

/// Maps points of the simplified mesh to the original by successive projection, with rules that keep a point
/// on its side of thin walls. Immutable after construction; map() and map_near() may be called from several
/// threads concurrently.
/// Source: Liu et al. 2024 (arXiv 2409.15458)
///
/// The point p0 and the normal n0 of its simplified face are fixed. The walk starts at the simplified face
/// and follows the collapses that changed the current face backwards. At each of them, the next face is
/// chosen among the faces g of the patch before the collapse:
/// * g has the same group as the simplified face f0;
/// * g has the same orientation as f0, if there is such a face: s(f0) s(g) N_g . n0 >= 0.17, where N_g is the
///   unit normal of g and s is SurfacePatches::sign;
/// * g has the smallest score: the distance from p0, plus 0.3 mean edge lengths of the patch if g is not in
///   the ReplayTables::patch_component of the current face, plus one mean edge length if g is not in the
///   surface patch of f0.
///
/// If p0 lies on the current face, that face is kept. A walk that gets too long is aborted; the result is
/// then the closest face of the surface patch.
///
/// The intermediate faces of a walk may be far from the original, so that the walks of adjacent points
/// diverge. Therefore the final result is the closest point on all preimage faces that are accepted. A
/// preimage face is an original face with a corner that was collapsed into a corner of f0; a face is accepted
/// if it has the surface patch, group and orientation of f0. If the closest accepted face is near p0 and is a
/// preimage face, the walk could not change the result and is skipped.
class SuccessiveProjection {
public:
    /// \param history   valid; must outlive this object
    /// \param unwelded  see find_surface_patches()
    /// \param context   of the construction
    /// \throws whatever `context` throws
    /// O(n log n) in the faces of the original, plus O(size of the history)
    explicit SuccessiveProjection(const CollapseHistory& history, std::span<const Triangle> unwelded = {},
                                  const RunContext& context = {});

    /// Maps one point.
    /// \param face         face of the simplified mesh
    /// \param barycentric  weights of its three corners, >= 0, sum 1
    /// \return a point on the original; its face is never no_index
    /// O(log faces) typically, plus the length of the walk if one is needed
    SurfacePoint map(Index face, const Vec3& barycentric) const;

    /// Same as map(), faster: the result `near` for a nearby point on the same simplified face bounds the
    /// distance, and the walk is usually not needed. The result may differ only if the walk would find a face
    /// that is not accepted. Calls map() if `near` is not accepted, and does the walk if the closest accepted
    /// face is not a preimage face.
    SurfacePoint map_near(Index face, const Vec3& barycentric, const SurfacePoint& near) const;

    /// Finds the accepted faces that can be the closest to most points of a simplified face within a ball.
    /// \param face         face of the simplified mesh
    /// \param barycentric  weights of its three corners at the centre of the ball; may be negative, sum 1
    /// \param radius       of the ball, in model units
    /// \param near         result for a nearby point on the same simplified face
    /// \param faces        receives them; empty if there are too many for it, or many faces that are not accepted
    void find_accepted_faces(Index face, const Vec3& barycentric, double radius, const SurfacePoint& near,
                             NearTriangles& faces) const;

    /// What a call of map_near() with a list of faces leaves for the next one.
    struct Recent {
        NearTriangles::Recent search;
        Index face = no_index;     ///< of the original: the last one found
        bool is_preimage = false;  ///< whether that is a preimage face
    };

    /// Same result as map_near(), faster with the faces that find_accepted_faces() found for a ball around the point.
    /// \param recent  of the last call with the same list and simplified face, or of none
    SurfacePoint map_near(Index face, const Vec3& barycentric, const SurfacePoint& near,
                          const NearTriangles& faces, Recent& recent) const;

    /// The result of map_near(), up to rounding, where the point is certainly projected to the face of the last call.
    /// \param face         simplified face of that call
    /// \param barycentric  weights of its three corners
    /// \param step         of the last result
    /// \param faces        of that call
    /// \param recent       of that call
    /// \return nothing where map_near() has to search
    /// O(1)
    std::optional<SurfacePoint> map_to_same(Index face, const Vec3& barycentric, MapStep step,
                                            const NearTriangles& faces, Recent& recent) const;

    /// Position of a point of the simplified mesh.
    /// \param face         face of the simplified mesh
    /// \param barycentric  weights of its three corners
    Vector3 position_on(Index face, const Vec3& barycentric) const {
        Vector3 p = Vector3::Zero();
        for (std::size_t i = 0; i < 3; ++i) p += barycentric[i] * to_eigen(replay_.corner_positions[face][i]);
        return p;
    }

private:
    struct Query;
    struct ScoredFace;
    struct WalkEnd;
    struct Patch;

    Query make_query(Index face, const Vec3& barycentric) const;
    bool is_facing_away(Index candidate, const Vector3& area_vector, const Query& query) const;
    ScoredFace best_of_patch(Index collapse, Index face, const Query& query, std::uint64_t& visited) const;
    void consider(std::uint64_t entry, Patch& patch) const;
    WalkEnd walk(Index face, const Query& query) const;
    SurfacePoint map_by_walk(Index face, const Query& query) const;
    SurfacePoint snap_to_closest(const Query& query, Index face, MapStep step) const;
    template <class Filter>
    Bvh::Hit closest_accepted_if(const Query& query, double distance_squared, Filter&& filter) const;
    Bvh::Hit closest_accepted(const Query& query, double distance_squared) const;
    SurfacePoint closest_preimage_face(const Query& query, double distance_squared) const;
    bool is_preimage_face(Index original_face, const Triangle& corners) const;
    ClosestPoint on_original(Index face, const Vector3& p0) const;
    bool is_accepted(Index original_face, const Query& query) const;
    bool is_accepted(const Bvh::Corners& original_face, const Query& query) const;
    Index group(Index f) const { return history_.face_groups.empty() ? 0 : history_.face_groups[f]; }

    const CollapseHistory& history_;
    Bvh tree_;
    SurfacePatches surface_patches_;
    ReplayTables replay_;
    std::vector<Index> last_;  ///< final_versions() of the history
};

FAQEM_DETAIL_END

#ifdef FAQEM_HEADER_ONLY
#include "faqem/detail/mapping/successive_projection-inl.hpp"
#endif
