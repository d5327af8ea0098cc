#pragma once

#include "faqem/detail/mapping/successive_projection.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "faqem/detail/geometry/triangle.hpp"
#include "faqem/detail/history/final_versions.hpp"

FAQEM_DETAIL_BEGIN

// Penalties of the score, in mean edge lengths of the patch.
inline constexpr double component_penalty = 0.3;
inline constexpr double surface_patch_penalty = 1.0;
// Maximum number of faces that a closest-point search rejects. If there are many other faces between a point
// and its surface patch, it would otherwise visit all of them for every point.
inline constexpr std::size_t max_rejections = 512;
// Surface patches with at most this many faces are searched linearly. Fins, for example, are patches of one
// face each, with hundreds of closer faces of other patches.
inline constexpr std::size_t small_surface_patch = 32;
// Maximum number of faces that a walk visits, about ten times the usual number. If all vertices of a plane
// were collapsed into one vertex, one after the other, a face can be in the patches of all these collapses.
inline constexpr std::uint64_t max_visited_faces = max_entries_of_patch;
// A point lies on a face if its distance is at most this fraction of the mean edge length of the patch.
inline constexpr double coincidence_tolerance = 1e-6;
// Distance below which no walk is needed, as a fraction of the longest edge of the simplified face.
inline constexpr double near_threshold = 0.25;
inline constexpr double unbounded = std::numeric_limits<double>::infinity();

inline double distance_squared(const Vector3& p, const BoundingSphere& bound) {
    return (p - Vector3(bound.centre[0], bound.centre[1], bound.centre[2])).squaredNorm();
}

// A point of the simplified mesh, and properties of its face.
struct SuccessiveProjection::Query {
    Vector3 p0, n0;             // n0 is zero if the face has no area; then all orientations are accepted
    Triangle corners;           // versions
    double longest_edge = 0;    // model units
    Index original = no_index;  // input face of the simplified face
    Index surface_patch = no_index, group = no_index;
    double sign = 1;  // SurfacePatches::sign
};

// The best face of a patch.
struct SuccessiveProjection::ScoredFace {
    Index face = no_index;
    std::uint64_t entry = 0;      // see ReplayTables
    bool is_approximate = false;  // wrong orientation or other surface patch
    double score = unbounded;
};

// The face at which a walk ended.
struct SuccessiveProjection::WalkEnd {
    Index face;
    bool is_approximate = false;  // a face on the way was, or a patch had no face of the group
    bool is_aborted = false;      // the walk got too long
};

// A patch, and the best of its faces so far.
struct SuccessiveProjection::Patch {
    const Query& query;
    std::span<const Index> faces;
    std::uint64_t begin = 0;           // its first entry
    double edge = 0;                   // mean edge length
    std::uint8_t patch_component = 0;  // of the current face
    ScoredFace best, best_away;        // with the same orientation, and with another one
};

FAQEM_INLINE SuccessiveProjection::SuccessiveProjection(const CollapseHistory& history,
                                                        std::span<const Triangle> unwelded,
                                                        const RunContext& context)
    : history_(history) {
    // The tree and the surface patches do not need each other. The largest tables come after the tree, whose
    // construction needs temporary memory.
    parallel_blocks(2, 1, context, [&](std::size_t step, std::size_t, const RunContext& block_context) {
        if (step == 0)
            tree_ = Bvh(history.positions, history.triangles, block_context);
        else
            surface_patches_ = find_surface_patches(history.positions, history.triangles, unwelded);
    });
    replay_ = replay_patches(history);
    last_ = final_versions(history);
    describe_patches(history, surface_patches_.surface_patch, context, replay_);
}

FAQEM_INLINE SuccessiveProjection::Query SuccessiveProjection::make_query(Index face,
                                                                          const Vec3& barycentric) const {
    Query query;
    query.corners = replay_.corner_versions[face];
    const std::array<Vec3, 3>& positions = replay_.corner_positions[face];
    const Vector3 a = to_eigen(positions[0]), b = to_eigen(positions[1]), c = to_eigen(positions[2]);
    query.p0 = position_on(face, barycentric);
    const Vector3 n = engine::area_vector(a, b, c);
    const double length = n.norm();
    query.n0 = length > 0 ? Vector3(n / length) : Vector3::Zero();
    query.longest_edge =
        std::sqrt(std::max({(b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm()}));
    query.original = history_.remaining_faces[face];
    query.surface_patch = surface_patches_.surface_patch[query.original];
    query.sign = surface_patches_.sign[query.original];
    query.group = group(query.original);
    return query;
}

FAQEM_INLINE bool SuccessiveProjection::is_facing_away(Index candidate, const Vector3& area_vector,
                                                       const Query& query) const {
    if (query.n0.isZero(0)) return false;
    const double d = query.sign * surface_patches_.sign[candidate] * area_vector.dot(query.n0);
    return !(d > 0 && d * d >= min_facing_cosine * min_facing_cosine * area_vector.squaredNorm());
}

// The face with the smallest score, or of equal ones the one with the smallest index. Since the result does
// not depend on the order, the face with the closest bounding sphere is evaluated first, so that most others
// can be skipped by their bounding spheres.
FAQEM_INLINE SuccessiveProjection::ScoredFace SuccessiveProjection::best_of_patch(
    Index collapse, Index face, const Query& query, std::uint64_t& visited) const {
    const std::uint64_t begin = replay_.first_entry(history_, collapse),
                        end = replay_.first_entry(history_, collapse + 1);
    const std::span<const Index> faces = history_.patch(collapse);
    std::uint64_t own = begin, first = begin;
    while (own < end && faces[own - begin] != face) ++own;
    Patch patch{query, faces, begin, replay_.mean_edge[collapse], replay_.patch_component[own], {}, {}};
    consider(own, patch);
    ++visited;
    if (patch.best.score <= coincidence_tolerance * patch.edge) return patch.best;
    visited += end - begin;
    patch.best = patch.best_away = {};
    double nearest = unbounded;
    for (std::uint64_t e = begin; e < end; ++e) {
        const double d = distance_squared(query.p0, replay_.bounds[e]);
        if (d < nearest) nearest = d, first = e;
    }
    consider(first, patch);
    for (std::uint64_t e = begin; e < end; ++e)
        if (e != first) consider(e, patch);
    return patch.best.face != no_index ? patch.best : patch.best_away;
}

FAQEM_INLINE void SuccessiveProjection::consider(std::uint64_t e, Patch& patch) const {
    const Query& query = patch.query;
    const BoundingSphere& bound = replay_.bounds[e];
    const double limit = patch.best.face != no_index ? patch.best.score : unbounded;
    const double far = limit + bound.radius;
    if (distance_squared(query.p0, bound) > far * far) return;
    const Index g = patch.faces[e - patch.begin];
    if (group(g) != query.group) return;
    const Triangle& t = replay_.corners[e];
    const auto [a, b, c] = corners_of(replay_.positions, t);
    const bool away = is_facing_away(g, engine::area_vector(a, b, c), query);
    if (away && patch.best.face != no_index) return;
    const bool is_other_surface_patch = surface_patches_.surface_patch[g] != query.surface_patch;
    const double penalty =
        (replay_.patch_component[e] != patch.patch_component ? component_penalty * patch.edge : 0) +
        (is_other_surface_patch ? surface_patch_penalty * patch.edge : 0);
    const double score = std::sqrt(closest_point_on_triangle(query.p0, a, b, c).distance_squared) + penalty;
    ScoredFace& winner = away ? patch.best_away : patch.best;
    if (score < winner.score || (score == winner.score && g < winner.face))
        winner = {g, e, away || is_other_surface_patch, score};
}

FAQEM_INLINE ClosestPoint SuccessiveProjection::on_original(Index face, const Vector3& p0) const {
    const Triangle& t = history_.triangles[face];
    if (t[0] == no_index) return {Vector3::Zero(), {1, 0, 0}, unbounded};
    const auto [a, b, c] = corners_of(history_.positions, t);
    return closest_point_on_triangle(p0, a, b, c);
}

FAQEM_INLINE bool SuccessiveProjection::is_accepted(const Bvh::Corners& t, const Query& query) const {
    return surface_patches_.surface_patch[t.face] == query.surface_patch && group(t.face) == query.group &&
           !is_facing_away(t.face, engine::area_vector(t.a, t.b, t.c), query);
}

FAQEM_INLINE bool SuccessiveProjection::is_accepted(Index f, const Query& query) const {
    const Triangle& t = history_.triangles[f];
    if (t[0] == no_index) return false;
    const auto [a, b, c] = corners_of(history_.positions, t);
    return is_accepted({a, b, c, f}, query);
}

// Whether a corner of the original face was collapsed into a corner of the simplified face.
// \param corners  versions of the simplified face
FAQEM_INLINE bool SuccessiveProjection::is_preimage_face(Index original_face, const Triangle& corners) const {
    const Triangle& t = history_.triangles[original_face];
    return std::any_of(t.begin(), t.end(), [&](Index v) {
        const Index last = last_[v];
        return last == corners[0] || last == corners[1] || last == corners[2];
    });
}

// The closest face that is accepted and passes the filter, within a distance.
template <class Filter>
Bvh::Hit SuccessiveProjection::closest_accepted_if(const Query& query, double distance_squared,
                                                   Filter&& filter) const {
    const std::span<const Index> surface_patch = surface_patches_.faces[query.surface_patch];
    if (surface_patch.size() > small_surface_patch) {
        return tree_.closest_if(
            to_array(query.p0),
            [&](const Bvh::Corners& t) { return filter(t.face) && is_accepted(t, query); }, distance_squared,
            max_rejections);
    }
    Bvh::Hit best;
    best.distance_squared = distance_squared;
    for (const Index f : surface_patch) {  // ascending: of equally close faces, the smallest index is taken
        const ClosestPoint hit = on_original(f, query.p0);
        const bool nearer = hit.distance_squared < best.distance_squared ||
                            (hit.distance_squared == best.distance_squared && best.face == no_index);
        if (!nearer || !filter(f) || !is_accepted(f, query)) continue;
        best = {f, to_array(hit.barycentric), to_array(hit.point), hit.distance_squared};
    }
    return best;
}

FAQEM_INLINE Bvh::Hit SuccessiveProjection::closest_accepted(const Query& query,
                                                             double distance_squared) const {
    return closest_accepted_if(query, distance_squared, [](Index) { return true; });
}

FAQEM_INLINE SurfacePoint SuccessiveProjection::closest_preimage_face(const Query& query,
                                                                      double distance_squared) const {
    const Bvh::Hit hit = closest_accepted_if(query, distance_squared,
                                             [&](Index f) { return is_preimage_face(f, query.corners); });
    return {hit.face, hit.barycentric, MapStep::closest};
}

// The closest accepted preimage face, or `face` if none is as close as that.
FAQEM_INLINE SurfacePoint SuccessiveProjection::snap_to_closest(const Query& query, Index face,
                                                                MapStep step) const {
    const ClosestPoint here = on_original(face, query.p0);
    SurfacePoint result = closest_preimage_face(query, here.distance_squared);
    if (result.face == no_index) result = {face, to_array(here.barycentric), step};
    result.step = step;
    return result;
}

FAQEM_INLINE SuccessiveProjection::WalkEnd SuccessiveProjection::walk(Index face, const Query& query) const {
    WalkEnd end{query.original};
    std::uint64_t visited = 0;
    for (Index k = replay_.last_patches[face]; k != no_index;) {
        if (visited > max_visited_faces || !replay_.has_entries(history_, k)) {
            end.is_aborted = true;
            break;
        }
        const ScoredFace next = best_of_patch(k, end.face, query, visited);
        if (next.face == no_index) {
            end.is_approximate = true;
            break;
        }
        end.face = next.face;
        end.is_approximate = end.is_approximate || next.is_approximate;
        k = replay_.previous[next.entry];
    }
    return end;
}

FAQEM_INLINE SurfacePoint SuccessiveProjection::map_by_walk(Index face, const Query& query) const {
    const WalkEnd end = walk(face, query);
    if (!end.is_aborted && is_accepted(end.face, query))
        return snap_to_closest(query, end.face, end.is_approximate ? MapStep::approximate : MapStep::history);
    const ClosestPoint here = on_original(end.face, query.p0);
    const double far = std::sqrt(here.distance_squared) + query.longest_edge;
    if (end.is_aborted) {
        const Bvh::Hit hit = closest_accepted(query, far * far);
        if (hit.face != no_index) return {hit.face, hit.barycentric, MapStep::closest};
    }
    const SurfacePoint closest = closest_preimage_face(query, far * far);
    if (closest.face != no_index) return closest;
    return {end.face, to_array(here.barycentric), MapStep::approximate};
}

// Most points need no walk: wherever it ended, snap_to_closest() or map_by_walk() would select the closest
// accepted face if that is a preimage face and near enough.
FAQEM_INLINE SurfacePoint SuccessiveProjection::map(Index face, const Vec3& barycentric) const {
    const Query query = make_query(face, barycentric);
    const double close = near_threshold * query.longest_edge;
    const Bvh::Hit hit = closest_accepted(query, close * close);
    if (hit.face == no_index || !is_preimage_face(hit.face, query.corners)) return map_by_walk(face, query);
    return {hit.face, hit.barycentric, MapStep::history};
}

FAQEM_INLINE SurfacePoint SuccessiveProjection::map_near(Index face, const Vec3& barycentric,
                                                         const SurfacePoint& near) const {
    const Query query = make_query(face, barycentric);
    if (!is_accepted(near.face, query)) return map(face, barycentric);
    const ClosestPoint here = on_original(near.face, query.p0);
    const Bvh::Hit hit = closest_accepted(query, here.distance_squared);
    if (hit.face == no_index) return {near.face, to_array(here.barycentric), near.step};
    // In flat regions most faces are not preimage faces. Without the walk, all following points would keep
    // the face of `near`.
    return is_preimage_face(hit.face, query.corners) ? SurfacePoint{hit.face, hit.barycentric, near.step}
                                                     : map_by_walk(face, query);
}

FAQEM_INLINE void SuccessiveProjection::find_accepted_faces(Index face, const Vec3& barycentric,
                                                            double radius, const SurfacePoint& near,
                                                            NearTriangles& faces) const {
    faces.clear();
    const Query query = make_query(face, barycentric);
    if (!is_accepted(near.face, query)) return;
    double least = std::sqrt(on_original(near.face, query.p0).distance_squared);
    struct Candidate {
        const Bvh::Corners* face;
        double distance_squared;  // or that of its bounding box
    };
    std::vector<Candidate> candidates;
    std::size_t rejections = 0;
    // Some of the candidates are left out later, when a closer face is known.
    const auto is_too_long = [&] {
        return rejections >= max_rejections || candidates.size() > 2 * NearTriangles::max_size;
    };
    const auto reach_squared = [&] {
        const double reach = NearTriangles::usual_reach(least, radius);
        return reach * reach;
    };
    constexpr double stop_search = -1;
    tree_.visit_near(
        to_array(query.p0), [&] { return is_too_long() ? stop_search : reach_squared(); },
        [&](const Bvh::Corners& t, double distance_squared) {
            if (!is_accepted(t, query)) {
                ++rejections;
                return;
            }
            if (distance_squared < least * least) {
                distance_squared = closest_point_on_triangle(query.p0, t.a, t.b, t.c).distance_squared;
                least = std::min(least, std::sqrt(distance_squared));
            }
            candidates.push_back({&t, distance_squared});
        });
    if (is_too_long()) return;
    const double farthest = reach_squared();
    std::erase_if(candidates, [&](const Candidate& c) { return !(c.distance_squared <= farthest); });
    if (candidates.size() > NearTriangles::max_size) return;
    std::vector<NearTriangles::Entry> entries;
    entries.reserve(candidates.size());
    for (const Candidate& c : candidates) entries.push_back({c.face->a, c.face->b, c.face->c, c.face->face});
    faces.reset(query.p0, NearTriangles::usual_reach(least, radius), std::move(entries));
}

FAQEM_INLINE SurfacePoint SuccessiveProjection::map_near(Index face, const Vec3& barycentric,
                                                         const SurfacePoint& near, const NearTriangles& faces,
                                                         Recent& recent) const {
    const std::optional<NearTriangles::Hit> hit =
        faces.closest(position_on(face, barycentric), recent.search);
    if (!hit) {
        recent.face = no_index, recent.is_preimage = false;
        return map_near(face, barycentric, near);
    }
    const Index found = hit->entry->face;
    if (recent.face != found) {
        recent.face = found;
        recent.is_preimage = is_preimage_face(found, replay_.corner_versions[face]);
    }
    // All faces of the list are accepted.
    if (near.face != found && !faces.contains(near.face) &&
        !is_accepted(near.face, make_query(face, barycentric)))
        return map(face, barycentric);
    if (!recent.is_preimage) return map_by_walk(face, make_query(face, barycentric));
    return {found, to_array(hit->at.barycentric), near.step};
}

FAQEM_INLINE std::optional<SurfacePoint> SuccessiveProjection::map_to_same(
    Index face, const Vec3& barycentric, MapStep step, const NearTriangles& faces, Recent& recent) const {
    if (!recent.is_preimage) return std::nullopt;
    const std::optional<Vec3> at = faces.projection(position_on(face, barycentric), recent.search);
    if (!at) return std::nullopt;
    return SurfacePoint{recent.face, *at, step};
}

FAQEM_DETAIL_END
