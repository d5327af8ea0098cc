#pragma once

#include "faqem/detail/fitting/edge_flip_search.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "faqem/detail/base/buckets.hpp"
#include "faqem/detail/base/parallel.hpp"
#include "faqem/detail/geometry/edge_flip.hpp"
#include "faqem/detail/geometry/halfedges.hpp"

FAQEM_DETAIL_BEGIN

/// Maximum ratio of the distance integrals after and before a flip.
inline constexpr double max_error_ratio = 0.98;
/// A flip may increase the squared maximum distance of its quadrilateral to this fraction of the overall one.
inline constexpr double max_distance_share = 0.5;
/// Minimum area of a new face, as a fraction of the area of the quadrilateral.
inline constexpr double min_flipped_area = 1e-3;
/// Minimum cosines between the normals: of a new face and the mean of the old ones, of the two new faces, and
/// of a new face and an adjacent one.
inline constexpr double min_flip_normal_cosine = 0.2, min_flip_dihedral_cosine = -0.2,
                        min_flip_fold_cosine = -0.9;
/// Barycentric coordinates of the sample points of a face.
inline constexpr std::array<Vec3, 10> sample_pattern = {{{1.0 / 3, 1.0 / 3, 1.0 / 3},
                                                         {0.2, 0.6, 0.2},
                                                         {0.2, 0.2, 0.6},
                                                         {0.6, 0.2, 0.2},
                                                         {0.1, 0.45, 0.45},
                                                         {0.45, 0.1, 0.45},
                                                         {0.45, 0.45, 0.1},
                                                         {0.075, 0.85, 0.075},
                                                         {0.075, 0.075, 0.85},
                                                         {0.85, 0.075, 0.075}}};

/// Deviation of a part of the surface.
struct SurfaceDeviation {
    double distance_integral = 0;     ///< integral of d^2.5, d the distance
    double normal_deviation = 0;      ///< integral of the distances between the unit normals
    double max_squared_distance = 0;  ///< square of the maximum distance

    /// \param weight  area that the point represents
    void add(double distance_squared, double weight) {
        distance_integral += weight * distance_squared * std::sqrt(std::sqrt(distance_squared));
        max_squared_distance = std::max(max_squared_distance, distance_squared);
    }
    void add(const SurfaceDeviation& other) {
        distance_integral += other.distance_integral;
        normal_deviation += other.normal_deviation;
        max_squared_distance = std::max(max_squared_distance, other.max_squared_distance);
    }
    /// \param far_enough  squared distance up to which the maximum distance may increase
    bool is_better_than(const SurfaceDeviation& other, double far_enough) const {
        if (!(distance_integral <= max_error_ratio * other.distance_integral)) return false;
        if (!(max_squared_distance <= std::max(other.max_squared_distance, far_enough))) return false;
        return !(normal_deviation > other.normal_deviation) ||
               distance_integral * normal_deviation <= other.distance_integral * other.normal_deviation;
    }
};

/// Implementation of find_edge_flips().
class EdgeFlipSearch {
public:
    EdgeFlipSearch(const SimplifiedMeshRef& simplified, const ReferenceSurface& original,
                   const ReferenceToMeshTracker& even_samples,
                   const ReferenceToMeshTracker& original_vertices, double area, const RunContext& context)
        : simplified_(simplified),
          original_(original),
          even_samples_(even_samples),
          original_vertices_(original_vertices),
          weight_(area / static_cast<double>(std::max<std::size_t>(even_samples.size(), 1))),
          context_(context),
          halfedges_(sorted_halfedges(simplified.triangles)) {
        group_points_by_face();
    }

    std::vector<EdgeFlip> operator()() {
        std::vector<Candidate> candidates = find_candidates();
        parallel_each(candidates.size(), 64, context_,
                      [&](std::size_t i) { measure_from_original(candidates[i]); });
        std::erase_if(candidates, [](const Candidate& c) {
            return !(c.after.distance_integral <= c.before.distance_integral);
        });
        measure_faces(candidates);
        parallel_each(candidates.size(), 16, context_,
                      [&](std::size_t i) { measure_to_original(candidates[i]); });
        return select_independent(candidates);
    }

private:
    /// A point of the original.
    struct Point {
        const ReferenceToMeshTracker* from = nullptr;
        std::size_t number = 0;  ///< in `from`
    };
    struct Candidate {
        EdgeFlip faces;
        Quadrilateral corners;
        SurfaceDeviation before, after;
        double gain = 0;
    };

    Vector3 area_vector(const Triangle& t) const { return detail::area_vector(simplified_.positions, t); }
    const Vector3& at(Index v) const { return simplified_.positions[v]; }
    ClosestPoint closest(const Vector3& p, const Triangle& t) const {
        return closest_point_on_triangle(p, at(t[0]), at(t[1]), at(t[2]));
    }

    /// Groups the points of the original by their closest face, and finds the maximum distance.
    void group_points_by_face() {
        const std::array all = {&even_samples_, &original_vertices_};
        points_of_face_ = Buckets<Point>(simplified_.triangles.size(), [&](auto&& put) {
            for (const ReferenceToMeshTracker* from : all)
                for (std::size_t i = 0; i < from->size(); ++i) put(from->sample(i).face, Point{from, i});
        });
        for (const ReferenceToMeshTracker* from : all)
            for (std::size_t i = 0; i < from->size(); ++i)
                max_squared_distance_ = std::max(max_squared_distance_, from->squared_distance(i));
    }

    std::vector<Candidate> find_candidates() const {
        std::vector<Candidate> all;
        for_each_edge(halfedges_, [&](std::span<const Halfedge> on) {
            context_.count();
            if (on.size() != 2 || (simplified_.fixed[on[0].low] && simplified_.fixed[on[0].high])) return;
            const EdgeFlip faces = {on[0].face, on[1].face};
            if (!simplified_.groups.empty() && simplified_.groups[faces[0]] != simplified_.groups[faces[1]])
                return;
            const auto q = quadrilateral(simplified_.triangles[faces[0]], simplified_.triangles[faces[1]]);
            if (q && halfedges_between(q->c, q->d).empty() && is_valid_flip(*q))
                all.push_back({faces, *q, {}, {}});
        });
        return all;
    }

    /// Whether the new faces are no slivers, have normals similar to the old ones, and make no fold.
    bool is_valid_flip(const Quadrilateral& q) const {
        const Vector3 old = area_vector(q.first()) + area_vector(q.second());
        const Vector3 s = area_vector(q.first_flipped()), t = area_vector(q.second_flipped());
        const double before = area_vector(q.first()).norm() + area_vector(q.second()).norm();
        for (const Vector3& n : {s, t}) {
            if (!(n.norm() > min_flipped_area * before) ||
                !(n.dot(old) > min_flip_normal_cosine * n.norm() * old.norm()))
                return false;
        }
        if (!(s.dot(t) > min_flip_dihedral_cosine * s.norm() * t.norm())) return false;
        return !makes_fold(q.c, q.a, s) && !makes_fold(q.a, q.d, s) && !makes_fold(q.d, q.b, t) &&
               !makes_fold(q.b, q.c, t);
    }

    /// Whether a new face on the edge vw is folded over an existing face at that edge.
    /// \param area  area vector of the new face
    bool makes_fold(Index v, Index w, const Vector3& area) const {
        for (const Halfedge& halfedge : halfedges_between(v, w)) {
            const Vector3 n = area_vector(simplified_.triangles[halfedge.face]);
            if (n.dot(area) < min_flip_fold_cosine * n.norm() * area.norm()) return true;
        }
        return false;
    }

    std::span<const Halfedge> halfedges_between(Index v, Index w) const {
        const Halfedge* all = halfedges_.data();
        const auto [begin, end] =
            std::equal_range(all, all + halfedges_.size(), Halfedge{std::min(v, w), std::max(v, w)},
                             [](const Halfedge& a, const Halfedge& b) { return a.edge() < b.edge(); });
        return {begin, end};
    }

    /// Adds the distances from the points of the original whose closest face is one of the two.
    void measure_from_original(Candidate& c) const {
        const Quadrilateral& q = c.corners;
        const std::array<Triangle, 2> old = {q.first(), q.second()},
                                      now = {q.first_flipped(), q.second_flipped()};
        const auto normals = [&](const std::array<Triangle, 2>& faces) {
            return std::array<Vector3, 2>{area_vector(faces[0]).normalized(),
                                          area_vector(faces[1]).normalized()};
        };
        const std::array<Vector3, 2> old_normals = normals(old), now_normals = normals(now);
        for (const Index f : c.faces) {
            for (const auto& [from, i] : points_of_face_[f]) {
                const double weight = from == &even_samples_ ? weight_ : 0;
                add(from->point(i), old, old_normals, weight, c.before);
                add(from->point(i), now, now_normals, weight, c.after);
            }
        }
    }

    void add(const OrientedPoint& p, const std::array<Triangle, 2>& faces,
             const std::array<Vector3, 2>& normals, double weight, SurfaceDeviation& error) const {
        const double first = closest(p.position, faces[0]).distance_squared,
                     second = closest(p.position, faces[1]).distance_squared;
        error.add(std::min(first, second), weight);
        error.normal_deviation += weight * (p.normal - normals[second < first]).norm();
    }

    /// Deviation of a face, measured from its sample points to the original.
    SurfaceDeviation deviation_of(const Triangle& t) const {
        SurfaceDeviation error;
        const Vector3 area = area_vector(t), normal = area.normalized();
        const double weight = 0.5 * area.norm() / static_cast<double>(sample_pattern.size());
        for (const Vec3& w : sample_pattern) {
            const Vector3 p = w[0] * at(t[0]) + w[1] * at(t[1]) + w[2] * at(t[2]);
            const Bvh::Hit hit = original_.tree.closest(to_array(p));
            error.add(hit.distance_squared, weight);
            error.normal_deviation += weight * (original_.normals[hit.face] - normal).norm();
        }
        return error;
    }

    double midpoint_squared_distance(Index v, Index w) const {
        return original_.tree.closest(to_array(Vector3(0.5 * (at(v) + at(w))))).distance_squared;
    }

    /// Measures each current face of the candidates once; it may belong to three candidates.
    void measure_faces(std::span<const Candidate> candidates) {
        std::vector<Index> wanted;
        for (const Candidate& c : candidates) wanted.insert(wanted.end(), c.faces.begin(), c.faces.end());
        std::sort(wanted.begin(), wanted.end());
        wanted.erase(std::unique(wanted.begin(), wanted.end()), wanted.end());
        face_deviation_.resize(simplified_.triangles.size());
        parallel_each(wanted.size(), 64, context_, [&](std::size_t i) {
            face_deviation_[wanted[i]] = deviation_of(simplified_.triangles[wanted[i]]);
        });
    }

    /// Adds the distances from sample points of the faces to the original, and computes the gain. Ends early
    /// if the flip cannot be an improvement.
    void measure_to_original(Candidate& c) const {
        const Quadrilateral& q = c.corners;
        for (const Index f : c.faces) c.before.add(face_deviation_[f]);
        c.before.max_squared_distance =
            std::max(c.before.max_squared_distance, midpoint_squared_distance(q.a, q.b));
        const double far_enough = max_distance_share * max_squared_distance_;
        for (const Triangle& t : {q.first_flipped(), q.second_flipped()}) {
            c.after.add(deviation_of(t));
            if (!(c.after.distance_integral <= max_error_ratio * c.before.distance_integral)) return;
        }
        c.after.max_squared_distance =
            std::max(c.after.max_squared_distance, midpoint_squared_distance(q.c, q.d));
        if (c.after.is_better_than(c.before, far_enough))
            c.gain = c.before.distance_integral - c.after.distance_integral;
    }

    /// Selects independent flips greedily, by decreasing gain.
    std::vector<EdgeFlip> select_independent(std::vector<Candidate>& candidates) const {
        std::erase_if(candidates, [](const Candidate& c) { return !(c.gain > 0); });
        std::stable_sort(candidates.begin(), candidates.end(),
                         [](const Candidate& a, const Candidate& b) { return a.gain > b.gain; });
        std::vector<EdgeFlip> chosen;
        std::vector<std::uint8_t> flipped(simplified_.triangles.size(), 0);
        std::set<std::pair<Index, Index>> made;
        for (const Candidate& c : candidates) {
            context_.count();
            const Quadrilateral& q = c.corners;
            bool is_free = true;
            for (const auto& [v, w] : {std::pair(q.a, q.b), std::pair(q.b, q.c), std::pair(q.c, q.a),
                                       std::pair(q.a, q.d), std::pair(q.d, q.b)}) {
                for (const Halfedge& halfedge : halfedges_between(v, w)) is_free &= !flipped[halfedge.face];
            }
            if (!is_free || !made.insert(std::minmax(q.c, q.d)).second) continue;
            for (const Index f : c.faces) flipped[f] = 1;
            chosen.push_back(c.faces);
        }
        return chosen;
    }

    const SimplifiedMeshRef& simplified_;
    const ReferenceSurface& original_;
    const ReferenceToMeshTracker& even_samples_;
    const ReferenceToMeshTracker& original_vertices_;
    double weight_;  // area that a point of even_samples_ represents
    const engine::RunContext& context_;
    std::vector<Halfedge> halfedges_;
    double max_squared_distance_ = 0;               // over all points of the original
    Buckets<Point> points_of_face_;                 // per face: points of the original that are closest to it
    std::vector<SurfaceDeviation> face_deviation_;  // per face; set for those of candidates
};

FAQEM_INLINE std::vector<EdgeFlip> find_edge_flips(const SimplifiedMeshRef& simplified,
                                                   const ReferenceSurface& original,
                                                   const ReferenceToMeshTracker& even_samples,
                                                   const ReferenceToMeshTracker& original_vertices,
                                                   double area, const RunContext& context) {
    return EdgeFlipSearch(simplified, original, even_samples, original_vertices, area, context)();
}

FAQEM_DETAIL_END
