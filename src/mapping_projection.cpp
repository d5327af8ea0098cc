#include "mapping_projection.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "triangle.hpp"

namespace faqem::detail {

using engine::to_array;
using engine::to_eigen;
using engine::Vector3;

namespace {

constexpr double least_cosine = 0.17;
constexpr double umbrella_penalty = 0.3;
constexpr double sheet_penalty = 1.0;
constexpr int longest_descent = 6;
constexpr double infinity = std::numeric_limits<double>::infinity();

bool has_corner(const Triangle& t, Index v) { return t[0] == v || t[1] == v || t[2] == v; }

bool shares_corner(const Triangle& a, const Triangle& b) {
    return has_corner(a, b[0]) || has_corner(a, b[1]) || has_corner(a, b[2]);
}

double distance_squared(const Vector3& p, const Bound& bound) {
    return (p - Vector3(bound.centre[0], bound.centre[1], bound.centre[2])).squaredNorm();
}

}  // namespace

struct ProjectionWalk::Query {
    Vector3 p0, n0;  // n0 zero: no side to look to
    Triangle corners;
    Index original = no_index;  // what the small face was
    Index sheet = no_index, group = no_index;
    double sign = 1;
};

struct ProjectionWalk::Best {
    Index face = no_index;
    std::uint64_t entry = 0;
    bool relaxed = false;
    double score = infinity;
};

// One patch and the best of its faces so far.
struct ProjectionWalk::Patch {
    const Query& query;
    double edge = 0;  // mean length
    std::uint8_t umbrella = 0;
    Best best, best_away;
};

ProjectionWalk::ProjectionWalk(const CollapseHistory& history)
    : history_(history),
      replay_(replay_patches(history)),
      sheets_(find_sheets(history.positions, history.triangles)),
      rings_(history.positions.size(), history.triangles) {}

ProjectionWalk::Query ProjectionWalk::start(Index face, const Vec3& barycentric) const {
    Query query;
    query.corners = replay_.kept_corners[face];
    const std::array<Vec3, 3>& places = replay_.kept_positions[face];
    const Vector3 a = to_eigen(places[0]), b = to_eigen(places[1]), c = to_eigen(places[2]);
    query.p0 = barycentric[0] * a + barycentric[1] * b + barycentric[2] * c;
    const Vector3 n = engine::area_vector(a, b, c);
    const double length = n.norm();
    query.n0 = length > 0 ? Vector3(n / length) : Vector3::Zero();
    query.original = history_.kept_faces[face];
    query.sheet = sheets_.sheet[query.original];
    query.sign = sheets_.sign[query.original];
    query.group = group(query.original);
    return query;
}

bool ProjectionWalk::faces_away(Index candidate, const Vector3& area_vector, const Query& query) const {
    if (query.n0.isZero(0)) return false;
    const double d = query.sign * sheets_.sign[candidate] * area_vector.dot(query.n0);
    return !(d > 0 && d * d >= least_cosine * least_cosine * area_vector.squaredNorm());
}

// The least score wins, then the smaller face, in whatever order the faces come: so the one that looks
// closest comes first, and spheres rule out most of the others.
ProjectionWalk::Best ProjectionWalk::best_of_patch(Index collapse, Index face, const Query& query) const {
    const std::uint64_t begin = history_.patch_begin[collapse], end = history_.patch_begin[collapse + 1];
    std::uint64_t own = begin, first = begin;
    double nearest = infinity;
    for (std::uint64_t e = begin; e < end; ++e) {
        if (history_.patch_faces[e] == face) own = e;
        const double d = distance_squared(query.p0, replay_.bounds[e]);
        if (d < nearest) nearest = d, first = e;
    }
    Patch patch{query, replay_.mean_edge[collapse], replay_.umbrella[own], {}, {}};
    consider(first, patch);
    for (std::uint64_t e = begin; e < end; ++e) {
        if (e != first) consider(e, patch);
    }
    return patch.best.face != no_index ? patch.best : patch.best_away;
}

void ProjectionWalk::consider(std::uint64_t e, Patch& patch) const {
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

SurfacePoint ProjectionWalk::on_original(Index face, const Vector3& p0, MapStep step) const {
    const Triangle& t = history_.triangles[face];
    if (t[0] == no_index) return {face, {1, 0, 0}, step};
    const ClosestPoint hit =
        closest_point_on_triangle(p0, to_eigen(history_.positions[t[0]]), to_eigen(history_.positions[t[1]]),
                                  to_eigen(history_.positions[t[2]]));
    return {face, to_array(hit.barycentric), step};
}

bool ProjectionWalk::passes(Index f, const Query& query) const {
    if (sheets_.sheet[f] != query.sheet || group(f) != query.group) return false;
    const Triangle& t = history_.triangles[f];
    return !faces_away(
        f,
        engine::area_vector(to_eigen(history_.positions[t[0]]), to_eigen(history_.positions[t[1]]),
                            to_eigen(history_.positions[t[2]])),
        query);
}

// Original faces by the last versions of their corners. Versions beyond the vertices are numbered as they
// are, so that FaceRings can serve.
const FaceRings& ProjectionWalk::descendants() const {
    std::call_once(descendants_once_, [this] {
        std::vector<Index> last(replay_.positions.size());
        std::iota(last.begin(), last.end(), Index{0});
        for (std::size_t k = history_.collapses.size(); k-- > 0;) {
            const Index made = last[history_.positions.size() + k];
            last[history_.collapses[k].first] = made;
            last[history_.collapses[k].second] = made;
        }
        std::vector<Triangle> triangles = history_.triangles;
        for (Triangle& t : triangles) {
            if (t[0] != no_index) t = {last[t[0]], last[t[1]], last[t[2]]};
        }
        descendants_ = std::make_unique<const FaceRings>(last.size(), triangles);
    });
    return *descendants_;
}

// The closest original face that passes the tests and has a corner that collapsed into one of the small
// face's.
SurfacePoint ProjectionWalk::closest_descendant(const Query& query) const {
    Index best = no_index;
    double least = infinity;
    for (const Index corner : query.corners) {
        for (const Index f : descendants().at(corner)) {
            if (!passes(f, query)) continue;
            const double d = distance_to_original(f, query.p0);
            if (d < least || (d == least && f < best)) least = d, best = f;
        }
    }
    return best == no_index ? SurfacePoint{} : on_original(best, query.p0, MapStep::closest);
}

double ProjectionWalk::distance_to_original(Index face, const Vector3& p) const {
    const Triangle& t = history_.triangles[face];
    return closest_point_on_triangle(p, to_eigen(history_.positions[t[0]]),
                                     to_eigen(history_.positions[t[1]]), to_eigen(history_.positions[t[2]]))
        .distance_squared;
}

SurfacePoint ProjectionWalk::map(Index face, const Vec3& barycentric) const {
    const Query query = start(face, barycentric);
    Best at{query.original, 0, false, infinity};
    bool relaxed = false;
    for (Index k = replay_.kept_last[face]; k != no_index; k = replay_.previous[at.entry]) {
        const Best next = best_of_patch(k, at.face, query);
        if (next.face == no_index) {
            relaxed = true;
            break;
        }
        at = next;
        relaxed = relaxed || next.relaxed;
    }
    const MapStep step = relaxed ? MapStep::relaxed : MapStep::history;
    const SurfacePoint answer = on_original(at.face, query.p0, step);
    if (!relaxed || passes(at.face, query)) return answer;
    const SurfacePoint closest = closest_descendant(query);
    return closest.face != no_index ? closest : answer;
}

SurfacePoint ProjectionWalk::map_near(Index face, const Vec3& barycentric, const SurfacePoint& near) const {
    if (near.step != MapStep::history) return map(face, barycentric);
    const Query query = start(face, barycentric);
    const SurfacePoint here = on_original(near.face, query.p0, near.step);
    if (here.barycentric[0] > 0 && here.barycentric[1] > 0 && here.barycentric[2] > 0) return here;
    Index found = near.face;
    if (!descend(query, found)) return map(face, barycentric);
    return found == near.face ? here : on_original(found, query.p0, MapStep::history);
}

// From `face` to the closest face around it, again and again. False when it takes too long: then the sample
// is not as close by as was thought. Every face is looked at once: those around the face before were, and are
// no closer. Whether a face passes is only asked where it is closer, which few are.
bool ProjectionWalk::descend(const Query& query, Index& face) const {
    double least = distance_to_original(face, query.p0);
    Triangle before = {no_index, no_index, no_index};
    for (int step = 0; step < longest_descent; ++step) {
        const Index from = face;
        const Triangle& at = history_.triangles[from];
        for (std::size_t i = 0; i < 3; ++i) {
            if (has_corner(before, at[i])) continue;
            for (const Index g : rings_.at(at[i])) {
                const Triangle& t = history_.triangles[g];
                const bool seen = g == from || shares_corner(t, before) || (i > 0 && has_corner(t, at[0])) ||
                                  (i > 1 && has_corner(t, at[1]));
                if (seen) continue;
                const double d = distance_to_original(g, query.p0);
                if ((d < least || (d == least && g < face)) && passes(g, query)) least = d, face = g;
            }
        }
        if (face == from) return true;
        before = at;
    }
    return false;
}

}  // namespace faqem::detail
