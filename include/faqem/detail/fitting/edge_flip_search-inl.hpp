#pragma once

#include "faqem/export.hpp"
#include "faqem/detail/fitting/edge_flip_search.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <utility>

#include "faqem/detail/base/bucketed.hpp"
#include "faqem/detail/geometry/edge_flip.hpp"
#include "faqem/detail/base/parallel.hpp"
#include "faqem/detail/geometry/halfedges.hpp"

FAQEM_NAMESPACE_BEGIN
namespace detail {

using engine::Vector3;

/// As much of the sum must be left at most.
inline constexpr double least_gain = 0.98;
/// The farthest point of the quadrilateral may come this near to the farthest of all, as a share of squares.
inline constexpr double far_share = 0.5;
/// Of the area of the quadrilateral that each new face must have.
inline constexpr double least_area = 1e-3;
/// Cosines: of new faces to the mean of the old ones, between the new faces, and to the faces around.
inline constexpr double min_flip_normal_cosine = 0.2, min_flip_dihedral_cosine = -0.2, min_flip_fold_cosine = -0.9;
/// Barycentric weights of points that are spread over a face.
inline constexpr std::array<Vec3, 10> pattern = {{{1.0 / 3, 1.0 / 3, 1.0 / 3},
                                           {0.2, 0.6, 0.2},
                                           {0.2, 0.2, 0.6},
                                           {0.6, 0.2, 0.2},
                                           {0.1, 0.45, 0.45},
                                           {0.45, 0.1, 0.45},
                                           {0.45, 0.45, 0.1},
                                           {0.075, 0.85, 0.075},
                                           {0.075, 0.075, 0.85},
                                           {0.85, 0.075, 0.075}}};

/// How well a surface fits.
struct Error {
    double sum = 0;       ///< integral of d^2.5
    double turn = 0;      ///< integral of the distances between the unit normals
    double farthest = 0;  ///< squared

    void add(double distance_squared, double weight) {
        sum += weight * distance_squared * std::sqrt(std::sqrt(distance_squared));
        farthest = std::max(farthest, distance_squared);
    }
    void add(const Error& other) {
        sum += other.sum;
        turn += other.turn;
        farthest = std::max(farthest, other.farthest);
    }
    bool is_better_than(const Error& other, double far_enough) const {
        if (!(sum <= least_gain * other.sum)) return false;
        if (!(farthest <= std::max(other.farthest, far_enough))) return false;
        return !(turn > other.turn) || sum * turn <= other.sum * other.turn;
    }
};

class EdgeSearch {
public:
    EdgeSearch(const LightMesh& light, const StillSurface& original, const GapsBack& even,
               const GapsBack& corners, double area, Workers workers)
        : light_(light),
          original_(original),
          even_(even),
          corners_(corners),
          weight_(area / static_cast<double>(std::max<std::size_t>(even.size(), 1))),
          workers_(workers),
          sides_(sorted_sides(light.triangles, workers.poll)) {
        bind();
    }

    std::vector<EdgeSwap> operator()() {
        std::vector<Candidate> candidates = find_candidates();
        parallel_blocks(candidates.size(), 64, workers_, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) look_back(candidates[i]);
        });
        std::erase_if(candidates, [](const Candidate& c) { return !(c.after.sum <= c.before.sum); });
        measure_faces(candidates);
        parallel_blocks(candidates.size(), 16, workers_, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) look_there(candidates[i]);
        });
        return choose(candidates);
    }

private:
    struct Candidate {
        EdgeSwap faces;
        Quadrilateral corners;
        Error before, after;
        double gain = 0;
    };

    Vector3 area_vector(const Triangle& t) const { return detail::area_vector(light_.positions, t); }
    const Vector3& at(Index v) const { return light_.positions[v]; }
    ClosestPoint closest(const Vector3& p, const Triangle& t) const {
        return closest_point_on_triangle(p, at(t[0]), at(t[1]), at(t[2]));
    }

    /// Vertices come after even points.
    void bind() {
        const std::size_t points = even_.size() + corners_.size();
        const auto face = [&](std::size_t i) {
            return i < even_.size() ? even_.spot(i).face : corners_.spot(i - even_.size()).face;
        };
        bound_ = Buckets<std::size_t>(light_.triangles.size(), [&](auto&& put) {
            for (std::size_t i = 0; i < points; ++i) {
                workers_.poll();
                put(face(i), i);
            }
        });
        for (std::size_t i = 0; i < points; ++i) {
            workers_.poll();
            const Vector3& gap = i < even_.size() ? even_.gap(i) : corners_.gap(i - even_.size());
            farthest_ = std::max(farthest_, gap.squaredNorm());
        }
    }

    bool has_edge(Index v, Index w) const {
        bool any = false;
        for_each_face_on(v, w, [&](const Side&) { any = true; });
        return any;
    }

    std::vector<Candidate> find_candidates() const {
        std::vector<Candidate> all;
        for_each_edge(sides_, [&](std::span<const Side> on) {
            workers_.poll();
            if (on.size() != 2 || (light_.fixed[on[0].low] && light_.fixed[on[0].high])) return;
            const EdgeSwap faces = {on[0].face, on[1].face};
            if (!light_.groups.empty() && light_.groups[faces[0]] != light_.groups[faces[1]]) return;
            const auto q = quadrilateral(light_.triangles[faces[0]], light_.triangles[faces[1]]);
            if (q && !has_edge(q->c, q->d) && is_sound(*q)) all.push_back({faces, *q, {}, {}});
        });
        return all;
    }

    /// Would the new faces be no slivers, and look where the old ones did?
    bool is_sound(const Quadrilateral& q) const {
        const Vector3 old = area_vector(q.first()) + area_vector(q.second());
        const Vector3 s = area_vector(q.first_swapped()), t = area_vector(q.second_swapped());
        const double before = area_vector(q.first()).norm() + area_vector(q.second()).norm();
        for (const Vector3& n : {s, t}) {
            if (!(n.norm() > least_area * before) || !(n.dot(old) > min_flip_normal_cosine * n.norm() * old.norm()))
                return false;
        }
        if (!(s.dot(t) > min_flip_dihedral_cosine * s.norm() * t.norm())) return false;
        return !folds(q.c, q.a, s) && !folds(q.a, q.d, s) && !folds(q.d, q.b, t) && !folds(q.b, q.c, t);
    }

    /// Would a new face on v and w look away from the one beyond that edge?
    bool folds(Index v, Index w, const Vector3& area) const {
        bool any = false;
        for_each_face_on(v, w, [&](const Side& side) {
            const Vector3 n = area_vector(light_.triangles[side.face]);
            any |= n.dot(area) < min_flip_fold_cosine * n.norm() * area.norm();
        });
        return any;
    }

    template <class Visit>
    void for_each_face_on(Index v, Index w, Visit&& visit) const {
        const std::uint64_t edge = Side{std::min(v, w), std::max(v, w)}.edge();
        auto side = std::lower_bound(sides_.begin(), sides_.end(), edge,
                                     [](const Side& a, std::uint64_t b) { return a.edge() < b; });
        for (; side != sides_.end() && side->edge() == edge; ++side) visit(*side);
    }

    /// From the original's points that are closest to the two faces.
    void look_back(Candidate& c) const {
        const Quadrilateral& q = c.corners;
        const std::array<Triangle, 2> old = {q.first(), q.second()},
                                      now = {q.first_swapped(), q.second_swapped()};
        const auto normals = [&](const std::array<Triangle, 2>& faces) {
            return std::array<Vector3, 2>{area_vector(faces[0]).normalized(),
                                          area_vector(faces[1]).normalized()};
        };
        const std::array<Vector3, 2> old_normals = normals(old), now_normals = normals(now);
        for (const Index f : c.faces) {
            for (const std::size_t i : bound_[f]) {
                const bool is_corner = i >= even_.size();
                const OrientedPoint& p = is_corner ? corners_.point(i - even_.size()) : even_.point(i);
                add(p, old, old_normals, is_corner ? 0 : weight_, c.before);
                add(p, now, now_normals, is_corner ? 0 : weight_, c.after);
            }
        }
    }

    void add(const OrientedPoint& p, const std::array<Triangle, 2>& faces,
             const std::array<Vector3, 2>& normals, double weight, Error& error) const {
        const double first = closest(p.position, faces[0]).distance_squared,
                     second = closest(p.position, faces[1]).distance_squared;
        error.add(std::min(first, second), weight);
        error.turn += weight * (p.normal - normals[second < first]).norm();
    }

    /// To the original from points of a face.
    Error from(const Triangle& t) const {
        Error error;
        const Vector3 area = area_vector(t), normal = area.normalized();
        const double weight = 0.5 * area.norm() / static_cast<double>(pattern.size());
        for (const Vec3& w : pattern) {
            const Vector3 p = w[0] * at(t[0]) + w[1] * at(t[1]) + w[2] * at(t[2]);
            const Bvh::Hit hit = original_.tree.closest(engine::to_array(p));
            error.add(hit.distance_squared, weight);
            error.turn += weight * (original_.normals[hit.face] - normal).norm();
        }
        return error;
    }

    double from_middle(Index v, Index w) const {
        return original_.tree.closest(engine::to_array(Vector3(0.5 * (at(v) + at(w))))).distance_squared;
    }

    /// Each face as it is, once, though it may be a candidate over three edges.
    void measure_faces(std::span<const Candidate> candidates) {
        std::vector<Index> wanted;
        for (const Candidate& c : candidates) wanted.insert(wanted.end(), c.faces.begin(), c.faces.end());
        std::sort(wanted.begin(), wanted.end(), engine::polled_less(workers_.poll));
        wanted.erase(std::unique(wanted.begin(), wanted.end()), wanted.end());
        from_face_.resize(light_.triangles.size());
        parallel_blocks(wanted.size(), 64, workers_, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) {
                from_face_[wanted[i]] = from(light_.triangles[wanted[i]]);
            }
        });
    }

    /// From points of the faces to the original, if that can still turn out well.
    void look_there(Candidate& c) const {
        const Quadrilateral& q = c.corners;
        for (const Index f : c.faces) c.before.add(from_face_[f]);
        c.before.farthest = std::max(c.before.farthest, from_middle(q.a, q.b));
        const double far_enough = far_share * farthest_;
        for (const Triangle& t : {q.first_swapped(), q.second_swapped()}) {
            c.after.add(from(t));
            if (!(c.after.sum <= least_gain * c.before.sum)) return;
        }
        c.after.farthest = std::max(c.after.farthest, from_middle(q.c, q.d));
        if (c.after.is_better_than(c.before, far_enough)) c.gain = c.before.sum - c.after.sum;
    }

    /// The best ones of which no two touch.
    std::vector<EdgeSwap> choose(std::vector<Candidate>& candidates) const {
        std::erase_if(candidates, [](const Candidate& c) { return !(c.gain > 0); });
        std::stable_sort(candidates.begin(), candidates.end(),
                         [this](const Candidate& a, const Candidate& b) {
                             workers_.poll();
                             return a.gain > b.gain;
                         });
        std::vector<EdgeSwap> chosen;
        std::vector<std::uint8_t> swapped(light_.triangles.size(), 0);
        std::set<std::pair<Index, Index>> made;
        for (const Candidate& c : candidates) {
            workers_.poll();
            const Quadrilateral& q = c.corners;
            bool is_free = true;
            for (const auto& [v, w] : {std::pair(q.a, q.b), std::pair(q.b, q.c), std::pair(q.c, q.a),
                                       std::pair(q.a, q.d), std::pair(q.d, q.b)}) {
                for_each_face_on(v, w, [&](const Side& side) { is_free &= !swapped[side.face]; });
            }
            if (!is_free || !made.insert(std::minmax(q.c, q.d)).second) continue;
            for (const Index f : c.faces) swapped[f] = 1;
            chosen.push_back(c.faces);
        }
        return chosen;
    }

    const LightMesh& light_;
    const StillSurface& original_;
    const GapsBack& even_;
    const GapsBack& corners_;
    double weight_;  // area of an even point
    Workers workers_;
    std::vector<Side> sides_;
    double farthest_ = 0;           // squared
    Buckets<std::size_t> bound_;    // the original's points by the faces that they are closest to
    std::vector<Error> from_face_;  // of faces of candidates
};

FAQEM_INLINE std::vector<EdgeSwap> better_edges(const LightMesh& light, const StillSurface& original, const GapsBack& even,
                                   const GapsBack& corners, double area, Workers workers) {
    return EdgeSearch(light, original, even, corners, area, workers)();
}

}  // namespace detail
FAQEM_NAMESPACE_END
