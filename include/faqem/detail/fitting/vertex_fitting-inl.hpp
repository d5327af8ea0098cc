#pragma once

#include "faqem/detail/fitting/vertex_fitting.hpp"
#include "faqem/export.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "faqem/detail/fitting/edge_flip_search.hpp"
#include "faqem/detail/fitting/fold_guard.hpp"
#include "faqem/detail/fitting/gauss_newton.hpp"
#include "faqem/detail/fitting/two_sided_error.hpp"
#include "faqem/detail/geometry/edge_flip.hpp"
#include "faqem/detail/geometry/halfedges.hpp"

FAQEM_NAMESPACE_BEGIN
namespace detail {

using engine::Vector3;

/// Times that edges are flipped, with fewer steps after each.
inline constexpr int flip_rounds = 2;
inline constexpr int first_steps = 4, later_steps = 2;
/// The sum of d^2.5 gets smaller: far points count more, so that the largest distance falls too.
inline constexpr double power = 0.5;
/// Points that end farther away than this share of the farthest at the start go back.
inline constexpr double revert_share = 0.9;
/// A face may not shrink below this share of its area.
inline constexpr double min_fitted_area = 0.05;
/// The fitting may not fold the surface at an edge: cosine between the normals.
inline constexpr double min_fitted_fold = -0.9;
/// Times that a step is halved where faces turn too far, before it is left out there.
inline constexpr int max_halvings = 6;
/// Times that far points are put back before all of them are.
inline constexpr int max_revert_rounds = 6;
/// Times that the farthest points are drawn in; they are those beyond this share of the farthest one; the
/// power of their distance by which they count; the squared distance that counts as nearer; and how much of a
/// factor gained there the sums may lose, as a power of it.
inline constexpr int max_farthest_rounds = 40;
inline constexpr double farthest_share = 0.9, farthest_power = 4, max_distance_ratio = 0.998,
                        tradeoff_exponent = 0.15;

/// Vertices on edges with one face.
inline std::vector<std::uint8_t> boundary_vertices(std::span<const Triangle> triangles, std::size_t vertices,
                                                   CancellationCheck check_cancelled) {
    std::vector<std::uint8_t> border(vertices, 0);
    for_each_edge(sorted_halfedges(triangles, check_cancelled), [&](std::span<const Halfedge> on) {
        if (on.size() == 1) border[on[0].low] = border[on[0].high] = 1;
    });
    return border;
}

class VertexFitting {
public:
    VertexFitting(const MeshRef& original, const MeshRef& simplified, std::span<const std::uint8_t> fixed,
                  double min_normal_cosine, Workers workers)
        : min_normal_cosine_(min_normal_cosine),
          workers_(workers),
          original_(original, workers),
          triangles_(simplified.triangles.begin(), simplified.triangles.end()),
          positions_(simplified.positions.begin(), simplified.positions.end()),
          fixed_(boundary_vertices(simplified.triangles, positions_.size(), workers.check_cancelled)),
          error_(original_, triangles_, positions_, workers) {
        for (std::size_t v = 0; v < fixed_.size(); ++v) fixed_[v] |= fixed[v];
    }

    /// Moves the vertices, by steps on all of them.
    void fit_all_vertices(int steps) {
        start_ = positions_;
        guard_.emplace(MeshRef{start_, triangles_}, min_fitted_fold, workers_.check_cancelled);
        if (error_.empty()) return;
        deviations_ = error_.measure(positions_);
        const std::vector<FaceDeviation> first = deviations_;
        const double before = max_squared_distance(first);
        for (int step = 0; step < steps; ++step) {
            move(gauss_newton_step(triangles_, error_.correspondences(), fixed_, power, workers_));
            if (step + 1 < steps) error_.update_correspondences(positions_);
        }
        deviations_ = error_.measure(positions_);
        for (int round = 0; round < max_revert_rounds && revert(first, before); ++round)
            deviations_ = error_.measure(positions_);
        if (!(max_squared_distance(deviations_) <= before)) {
            positions_ = start_;
            deviations_ = error_.measure(positions_);
        }
    }

    /// Draws in the farthest points: the vertices around them alone take steps that count the far ones most,
    /// as long as that helps. \pre fit_all_vertices()
    void reduce_max_distance() {
        if (deviations_.empty()) return;
        for (int round = 0; round < max_farthest_rounds; ++round) {
            const FaceDeviation before = sum(deviations_);
            std::vector<std::uint8_t> fixed(start_.size(), 1);
            for (std::size_t f = 0; f < deviations_.size(); ++f) {
                if (!(deviations_[f].max_squared_distance >
                      farthest_share * farthest_share * before.max_squared_distance))
                    continue;
                for (const Index v : triangles_[f]) fixed[v] = fixed_[v];
            }
            const std::vector<Correspondence> correspondences =
                error_.correspondences_at(movable_faces(fixed));
            if (!reduce_max_distance(
                    before, gauss_newton_step(triangles_, correspondences, fixed, farthest_power, workers_)))
                return;
        }
    }

    /// Swaps edges where that helps. \pre fit_all_vertices()
    std::vector<EdgeFlip> flip_edges(std::span<const Index> groups) {
        if (error_.empty()) return {};
        std::vector<EdgeFlip> better =
            find_edge_flips({positions_, triangles_, fixed_, groups}, original_, error_.from_reference(),
                            error_.from_reference_vertices(), area(original_.mesh), workers_);
        std::vector<std::uint8_t> flipped(triangles_.size(), 0);
        for (const EdgeFlip& flip : better) {
            flip_edge(triangles_[flip[0]], triangles_[flip[1]]);
            flipped[flip[0]] = flipped[flip[1]] = 1;
        }
        error_.resample_flipped(positions_, flipped);
        return better;
    }

    std::vector<Vector3> take_positions() { return std::move(positions_); }

private:
    /// A gain in distance at the cost of the normals is none, unless it is the larger one.
    static bool is_worse(const FaceDeviation& now, const FaceDeviation& before) {
        return now.normal_deviation > before.normal_deviation &&
               now.squared_distance_sum * now.normal_deviation * now.normal_deviation >
                   before.squared_distance_sum * before.normal_deviation * before.normal_deviation;
    }

    /// Is the farthest nearer, and do the sums lose less than it gains?
    static bool has_reduced_max_distance(const FaceDeviation& now, const FaceDeviation& before) {
        if (!(now.max_squared_distance < max_distance_ratio * before.max_squared_distance)) return false;
        const double gain =
            std::pow(before.max_squared_distance / now.max_squared_distance, tradeoff_exponent);
        const double normal_deviation_ratio = now.normal_deviation / before.normal_deviation;
        return now.squared_distance_sum <= gain * before.squared_distance_sum &&
               normal_deviation_ratio * normal_deviation_ratio <= gain;
    }

    static FaceDeviation sum(std::span<const FaceDeviation> deviations) {
        FaceDeviation all;
        for (const FaceDeviation& deviation : deviations) all.add(deviation);
        return all;
    }

    static double max_squared_distance(std::span<const FaceDeviation> deviations) {
        return sum(deviations).max_squared_distance;
    }

    /// Of the faces around each vertex together.
    std::vector<FaceDeviation> around_vertices(std::span<const FaceDeviation> deviations) const {
        std::vector<FaceDeviation> sums(start_.size());
        for (std::size_t f = 0; f < deviations.size(); ++f) {
            workers_.check_cancelled();
            if (triangles_[f][0] == no_index) continue;
            for (const Index v : triangles_[f]) sums[v].add(deviations[f]);
        }
        return sums;
    }

    /// Those with a vertex that is not fixed.
    std::vector<std::uint8_t> movable_faces(std::span<const std::uint8_t> fixed) const {
        std::vector<std::uint8_t> any(triangles_.size(), 0);
        for (std::size_t f = 0; f < any.size(); ++f) {
            workers_.check_cancelled();
            if (triangles_[f][0] == no_index) continue;
            for (const Index v : triangles_[f]) any[f] |= !fixed[v];
        }
        return any;
    }

    /// Takes the steps, shorter where a face would turn too far from where it was at the start, or the
    /// surface would fold.
    void move(std::vector<Vector3> step) {
        for (std::size_t v = 0; v < step.size(); ++v) {
            if (fixed_[v] || !step[v].allFinite()) step[v] = Vector3::Zero();
        }
        std::vector<Vector3> to(positions_.size());
        bool all_good = false;
        for (int round = 0; !all_good; ++round) {
            for (std::size_t v = 0; v < step.size(); ++v) to[v] = positions_[v] + step[v];
            all_good = true;
            for_each_invalid_face(to, [&](const Triangle& t) {
                for (const Index v : t) {
                    if (step[v].isZero(0)) continue;
                    step[v] *= round < max_halvings ? 0.5 : 0.0;
                    all_good = false;
                }
            });
        }
        positions_ = std::move(to);
    }

    /// Faces that have turned too far, or look away from a neighbour that they did not look away from.
    template <class Visit>
    void for_each_invalid_face(std::span<const Vector3> positions, Visit&& visit) const {
        for (const Triangle& t : triangles_) {
            workers_.check_cancelled();
            if (t[0] != no_index && !keeps_orientation(t, positions)) visit(t);
        }
        guard_->for_each_fold(
            positions, [&](const Triangle& s, const Triangle& t) { visit(s), visit(t); },
            workers_.check_cancelled);
    }

    bool keeps_orientation(const Triangle& t, std::span<const Vector3> positions) const {
        const Vector3 before = area_vector(start_, t), after = area_vector(positions, t);
        const double old_norm = before.norm(), new_norm = after.norm();
        return new_norm >= min_fitted_area * old_norm &&
               before.dot(after) >= min_normal_cosine_ * old_norm * new_norm;
    }

    /// False, and all is as it was: neither the step nor its half or quarter helps.
    bool reduce_max_distance(const FaceDeviation& before, std::vector<Vector3> step) {
        const std::vector<Vector3> from = positions_;
        for (int half = 0; half < 3; ++half) {
            move(step);
            deviations_ = error_.remeasure(positions_);
            if (has_reduced_max_distance(sum(deviations_), before)) return true;
            positions_ = from;
            for (Vector3& s : step) s *= 0.5;
        }
        deviations_ = error_.remeasure(positions_);
        return false;
    }

    /// Undoes the moves at faces with far points that were nearer before, and of vertices around which the
    /// faces fit worse than before. False: there were none.
    bool revert(std::span<const FaceDeviation> first, double before) {
        const double limit = revert_share * revert_share * before;
        bool any = false;
        for (std::size_t f = 0; f < deviations_.size(); ++f) {
            workers_.check_cancelled();
            const FaceDeviation& deviation = deviations_[f];
            if (deviation.max_squared_distance > limit &&
                deviation.max_squared_distance > first[f].max_squared_distance)
                any |= revert(triangles_[f]);
        }
        const std::vector<FaceDeviation> before_around = around_vertices(first),
                                         around = around_vertices(deviations_);
        for (Index v = 0; v < around.size(); ++v) {
            if (is_worse(around[v], before_around[v])) any |= revert(v);
        }
        // A face with some of its corners back may have turned: then all of them go back.
        for (bool turned = any; turned;) {
            turned = false;
            for_each_invalid_face(positions_, [&](const Triangle& t) { turned |= revert(t); });
        }
        return any;
    }

    bool revert(const Triangle& t) {
        bool any = false;
        for (const Index v : t) any |= revert(v);
        return any;
    }

    bool revert(Index v) {
        if (positions_[v] == start_[v]) return false;
        positions_[v] = start_[v];
        return true;
    }

    double min_normal_cosine_;
    Workers workers_;
    ReferenceSurface original_;
    std::vector<Triangle> triangles_;  // of the simplified mesh
    std::vector<Vector3> start_, positions_;
    std::vector<std::uint8_t> fixed_;
    std::optional<FoldGuard> guard_;
    TwoSidedError error_;
    std::vector<FaceDeviation> deviations_;  // of the faces of the simplified mesh
};

FAQEM_INLINE std::vector<Vector3> fit_vertices(const MeshRef& original, const MeshRef& simplified,
                                               std::span<const std::uint8_t> fixed, double min_normal_cosine,
                                               Workers workers) {
    VertexFitting fitting(original, simplified, fixed, min_normal_cosine, workers);
    fitting.fit_all_vertices(first_steps);
    fitting.reduce_max_distance();
    return fitting.take_positions();
}

FAQEM_INLINE FittingResult fit_vertices_and_flip_edges(const MeshRef& original, const MeshRef& simplified,
                                                       std::span<const std::uint8_t> fixed,
                                                       std::span<const Index> groups,
                                                       double min_normal_cosine, Workers workers) {
    VertexFitting fitting(original, simplified, fixed, min_normal_cosine, workers);
    FittingResult result;
    fitting.fit_all_vertices(first_steps);
    for (int round = 0; round < flip_rounds; ++round) {
        fitting.reduce_max_distance();
        const std::vector<EdgeFlip> better = fitting.flip_edges(groups);
        result.flips.insert(result.flips.end(), better.begin(), better.end());
        fitting.fit_all_vertices(later_steps);
    }
    fitting.reduce_max_distance();
    result.positions = fitting.take_positions();
    return result;
}

}  // namespace detail
FAQEM_NAMESPACE_END
