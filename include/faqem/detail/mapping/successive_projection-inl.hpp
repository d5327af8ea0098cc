#pragma once

#include "faqem/export.hpp"
#include "faqem/detail/mapping/successive_projection.hpp"

#include <algorithm>
#include <cmath>

#include "faqem/detail/history/final_versions.hpp"
#include "faqem/detail/geometry/triangle.hpp"

FAQEM_NAMESPACE_BEGIN
namespace detail {

using engine::to_array;
using engine::to_eigen;
using engine::Vector3;

inline constexpr double least_cosine = 0.17;
inline constexpr double umbrella_penalty = 0.3;
inline constexpr double sheet_penalty = 1.0;
// Of faces that the settling looks at in vain: where others lie between a point and its sheet, it would go
// through all of them for every sample.
inline constexpr std::size_t most_refused = 512;
// Of faces, of a sheet that is searched face by face: fins are sheets of one face each, with hundreds of others
// closer by.
inline constexpr std::size_t small_sheet = 32;
// Of faces that a walk looks at, about ten times what is usual: a vertex that swallowed a whole plain, one
// vertex after the other, was in a patch for each of them.
inline constexpr std::uint64_t most_walked = 2048;
// Of the mean edge of a patch: so close a point lies on the face at hand.
inline constexpr double on_it = 1e-6;
// Of a small face's longest edge: so close to it the closest face around is beyond doubt.
inline constexpr double close_by = 0.25;
inline constexpr double infinity = std::numeric_limits<double>::infinity();

inline double distance_squared(const Vector3& p, const Bound& bound) {
    return (p - Vector3(bound.centre[0], bound.centre[1], bound.centre[2])).squaredNorm();
}

struct ProjectionWalk::Query {
    Vector3 p0, n0;  // n0 zero: no side to look to
    Triangle corners;
    double longest_edge = 0;
    Index original = no_index;  // what the small face was
    Index sheet = no_index, group = no_index;
    double sign = 1;
};

struct ProjectionWalk::Best {
    Index face = no_index;
    std::uint64_t entry = 0;
    bool relaxed = false;
    double score = infinity;
    bool given_up = false;
};

// One patch and the best of its faces so far.
struct ProjectionWalk::Patch {
    const Query& query;
    double edge = 0;  // mean length
    std::uint8_t umbrella = 0;
    Best best, best_away;
};

FAQEM_INLINE ProjectionWalk::ProjectionWalk(const CollapseHistory& history, std::span<const Triangle> unwelded,
                               Workers workers)
    : history_(history),
      tree_(history.positions, history.triangles, workers.poll),
      sheets_(find_sheets(history.positions, history.triangles, unwelded, workers.poll)),
      replay_(replay_patches(history, workers.poll)),
      last_(final_versions(history)) {
    describe_patches(history, sheets_.sheet, workers, replay_);
}

FAQEM_INLINE ProjectionWalk::Query ProjectionWalk::start(Index face, const Vec3& barycentric) const {
    Query query;
    query.corners = replay_.kept_corners[face];
    const std::array<Vec3, 3>& places = replay_.kept_positions[face];
    const Vector3 a = to_eigen(places[0]), b = to_eigen(places[1]), c = to_eigen(places[2]);
    query.p0 = replay_.place(face, barycentric);
    const Vector3 n = engine::area_vector(a, b, c);
    const double length = n.norm();
    query.n0 = length > 0 ? Vector3(n / length) : Vector3::Zero();
    query.longest_edge =
        std::sqrt(std::max({(b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm()}));
    query.original = history_.kept_faces[face];
    query.sheet = sheets_.sheet[query.original];
    query.sign = sheets_.sign[query.original];
    query.group = group(query.original);
    return query;
}

FAQEM_INLINE bool ProjectionWalk::faces_away(Index candidate, const Vector3& area_vector, const Query& query) const {
    if (query.n0.isZero(0)) return false;
    const double d = query.sign * sheets_.sign[candidate] * area_vector.dot(query.n0);
    return !(d > 0 && d * d >= least_cosine * least_cosine * area_vector.squaredNorm());
}

// The least score wins, then the smaller face, in whatever order the faces come: so the one that looks
// closest comes first, and spheres rule out most of the others.
FAQEM_INLINE ProjectionWalk::Best ProjectionWalk::best_of_patch(Index collapse, Index face, const Query& query,
                                                   std::uint64_t& walked) const {
    const std::uint64_t begin = history_.patch_begin[collapse], end = history_.patch_begin[collapse + 1];
    std::uint64_t own = begin, first = begin;
    while (own < end && history_.patch_faces[own] != face) ++own;
    Patch patch{query, replay_.mean_edge[collapse], replay_.umbrella[own], {}, {}};
    consider(own, patch);
    ++walked;
    if (patch.best.score <= on_it * patch.edge) return patch.best;
    walked += end - begin;
    patch.best = patch.best_away = {};
    double nearest = infinity;
    for (std::uint64_t e = begin; e < end; ++e) {
        const double d = distance_squared(query.p0, replay_.bounds[e]);
        if (d < nearest) nearest = d, first = e;
    }
    consider(first, patch);
    for (std::uint64_t e = begin; e < end; ++e) {
        if (e != first) consider(e, patch);
    }
    return patch.best.face != no_index ? patch.best : patch.best_away;
}

FAQEM_INLINE void ProjectionWalk::consider(std::uint64_t e, Patch& patch) const {
    const Query& query = patch.query;
    const Bound& bound = replay_.bounds[e];
    const double limit = patch.best.face != no_index ? patch.best.score : infinity;
    const double far = limit + bound.radius;
    if (distance_squared(query.p0, bound) > far * far) return;
    const Index g = history_.patch_faces[e];
    if (group(g) != query.group) return;
    const Triangle& t = replay_.corners[e];
    const Vector3 a = to_eigen(replay_.positions[t[0]]), b = to_eigen(replay_.positions[t[1]]),
                  c = to_eigen(replay_.positions[t[2]]);
    const bool away = faces_away(g, engine::area_vector(a, b, c), query);
    if (away && patch.best.face != no_index) return;
    const bool other_sheet = sheets_.sheet[g] != query.sheet;
    const double penalty = (replay_.umbrella[e] != patch.umbrella ? umbrella_penalty * patch.edge : 0) +
                           (other_sheet ? sheet_penalty * patch.edge : 0);
    const double score = std::sqrt(closest_point_on_triangle(query.p0, a, b, c).distance_squared) + penalty;
    Best& winner = away ? patch.best_away : patch.best;
    if (score < winner.score || (score == winner.score && g < winner.face)) {
        winner = {g, e, away || other_sheet, score};
    }
}

FAQEM_INLINE ClosestPoint ProjectionWalk::on_original(Index face, const Vector3& p0) const {
    const Triangle& t = history_.triangles[face];
    if (t[0] == no_index) return {Vector3::Zero(), {1, 0, 0}, infinity};
    return closest_point_on_triangle(p0, to_eigen(history_.positions[t[0]]),
                                     to_eigen(history_.positions[t[1]]), to_eigen(history_.positions[t[2]]));
}

FAQEM_INLINE bool ProjectionWalk::passes(Index f, const Query& query) const {
    if (sheets_.sheet[f] != query.sheet || group(f) != query.group) return false;
    const Triangle& t = history_.triangles[f];
    return !faces_away(
        f,
        engine::area_vector(to_eigen(history_.positions[t[0]]), to_eigen(history_.positions[t[1]]),
                            to_eigen(history_.positions[t[2]])),
        query);
}

// Has a corner that collapsed into one of the small face's.
FAQEM_INLINE bool ProjectionWalk::is_around(Index original_face, const Query& query) const {
    const Triangle& t = history_.triangles[original_face];
    return std::any_of(t.begin(), t.end(), [&](Index v) {
        const Index last = last_[v];
        return last == query.corners[0] || last == query.corners[1] || last == query.corners[2];
    });
}

// The closest face of those that pass the tests and the filter.
template <class Filter>
Bvh::Hit ProjectionWalk::closest_that(const Query& query, double distance_squared, Filter&& filter) const {
    const std::span<const Index> sheet = sheets_.of(query.sheet);
    if (sheet.size() > small_sheet) {
        return tree_.closest_if(
            to_array(query.p0), [&](Index f) { return filter(f) && passes(f, query); }, distance_squared,
            most_refused);
    }
    Bvh::Hit best;
    best.distance_squared = distance_squared;
    for (const Index f : sheet) {  // in ascending order: of two as close the first stays
        const ClosestPoint hit = on_original(f, query.p0);
        const bool nearer = hit.distance_squared < best.distance_squared ||
                            (hit.distance_squared == best.distance_squared && best.face == no_index);
        if (!nearer || !filter(f) || !passes(f, query)) continue;
        best = {f, to_array(hit.barycentric), to_array(hit.point), hit.distance_squared};
    }
    return best;
}

FAQEM_INLINE Bvh::Hit ProjectionWalk::closest_passing(const Query& query, double distance_squared) const {
    return closest_that(query, distance_squared, [](Index) { return true; });
}

FAQEM_INLINE SurfacePoint ProjectionWalk::closest_around(const Query& query, double distance_squared) const {
    const Bvh::Hit hit = closest_that(query, distance_squared, [&](Index f) { return is_around(f, query); });
    return {hit.face, hit.barycentric, MapStep::closest};
}

// The closest face around that passes the tests, or `face` where none is as close.
FAQEM_INLINE SurfacePoint ProjectionWalk::settle(const Query& query, Index face, MapStep step) const {
    const ClosestPoint here = on_original(face, query.p0);
    SurfacePoint result = closest_around(query, here.distance_squared);
    if (result.face == no_index) result = {face, to_array(here.barycentric), step};
    result.step = step;
    return result;
}

FAQEM_INLINE ProjectionWalk::Best ProjectionWalk::walk(Index face, const Query& query) const {
    Best at{query.original, 0, false, infinity};
    bool relaxed = false;
    std::uint64_t walked = 0;
    for (Index k = replay_.kept_last[face]; k != no_index; k = replay_.previous[at.entry]) {
        if (walked > most_walked) {
            at.given_up = true;
            break;
        }
        const Best next = best_of_patch(k, at.face, query, walked);
        if (next.face == no_index) {
            relaxed = true;
            break;
        }
        at = next;
        relaxed = relaxed || next.relaxed;
    }
    at.relaxed = relaxed;
    return at;
}

FAQEM_INLINE SurfacePoint ProjectionWalk::by_walk(Index face, const Query& query) const {
    const Best end = walk(face, query);
    if (!end.given_up && passes(end.face, query)) {
        return settle(query, end.face, end.relaxed ? MapStep::relaxed : MapStep::history);
    }
    const ClosestPoint here = on_original(end.face, query.p0);
    const double far = std::sqrt(here.distance_squared) + query.longest_edge;
    if (end.given_up) {
        const Bvh::Hit hit = closest_passing(query, far * far);
        if (hit.face != no_index) return {hit.face, hit.barycentric, MapStep::closest};
    }
    const SurfacePoint closest = closest_around(query, far * far);
    if (closest.face != no_index) return closest;
    return {end.face, to_array(here.barycentric), MapStep::relaxed};
}

// Wherever a walk ends, settling takes the closest face that passes if it is around and no farther than the
// longest edge: most samples need no walk.
FAQEM_INLINE SurfacePoint ProjectionWalk::map(Index face, const Vec3& barycentric) const {
    const Query query = start(face, barycentric);
    const double close = close_by * query.longest_edge;
    const Bvh::Hit hit = closest_passing(query, close * close);
    if (hit.face == no_index || !is_around(hit.face, query)) return by_walk(face, query);
    return {hit.face, hit.barycentric, MapStep::history};
}

FAQEM_INLINE SurfacePoint ProjectionWalk::map_near(Index face, const Vec3& barycentric, const SurfacePoint& near) const {
    const Query query = start(face, barycentric);
    if (!passes(near.face, query)) return map(face, barycentric);
    const ClosestPoint here = on_original(near.face, query.p0);
    const Bvh::Hit hit = closest_passing(query, here.distance_squared);
    if (hit.face == no_index) return {near.face, to_array(here.barycentric), near.step};
    // On flat ground most faces are not around: `near` would hold on to the sample for the rest of its row.
    return is_around(hit.face, query) ? SurfacePoint{hit.face, hit.barycentric, near.step}
                                      : by_walk(face, query);
}

}  // namespace detail
FAQEM_NAMESPACE_END
