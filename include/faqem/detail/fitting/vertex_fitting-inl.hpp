#pragma once

#include "faqem/detail/fitting/vertex_fitting.hpp"

#include <algorithm>
#include <limits>
#include <optional>
#include <utility>

#include "faqem/detail/base/portable_math.hpp"
#include "faqem/detail/fitting/fold_guard.hpp"
#include "faqem/detail/fitting/gauss_newton.hpp"
#include "faqem/detail/fitting/two_sided_error.hpp"
#include "faqem/detail/geometry/edge_flip.hpp"
#include "faqem/engine/mesh/boundary_edges.hpp"

FAQEM_DETAIL_BEGIN

/// Number of Gauss-Newton steps at the beginning and after edge flips.
inline constexpr int first_steps = 3, later_steps = 2;
/// Steps minimize the sum of d^2.5, which emphasizes large distances and thus decreases the maximum as well.
inline constexpr double power = 0.5;
/// Faces whose maximum distance has increased above this fraction of the initial maximum are reverted.
inline constexpr double revert_share = 0.9;
/// Minimum area of a face, as a fraction of its initial area.
inline constexpr double min_fitted_area = 0.05;
/// Cosine between the normals of adjacent faces below which an edge is folded.
inline constexpr double min_fitted_fold = -0.9;
/// A step is halved this often at faces that it would make invalid, and then set to zero there.
inline constexpr int max_halvings = 6;
/// Maximum number of rounds of reverting vertices, before all of them are reverted if necessary.
inline constexpr int max_revert_rounds = 6;
/// Maximum number of rounds that decrease the maximum distance.
inline constexpr int max_farthest_rounds = 40;
/// Faces whose maximum distance exceeds this fraction of the overall maximum are moved in these rounds.
inline constexpr double farthest_share = 0.9;
/// Power of the distance by which points are weighted in these rounds.
inline constexpr double farthest_power = 4;
/// The squared maximum distance must decrease by at least this factor in a round.
inline constexpr double max_distance_ratio = 0.998;
/// If the squared maximum distance decreases by a factor f, the sums may increase by f to this power.
inline constexpr double tradeoff_exponent = 0.15;

/// Implementation of fit_vertices().
class VertexFitting {
public:
    VertexFitting(const MeshRef& original, const MeshRef& simplified, std::span<const std::uint8_t> fixed,
                  double min_normal_cosine, const RunContext& context)
        : min_normal_cosine_(min_normal_cosine),
          context_(context),
          original_(original, context),
          triangles_(simplified.triangles.begin(), simplified.triangles.end()),
          positions_(simplified.positions.begin(), simplified.positions.end()),
          fixed_(fixed.begin(), fixed.end()),
          error_(original_, triangles_, positions_, context) {
        for (const auto& [a, b] : engine::find_boundary_edges(triangles_, positions_.size()))
            fixed_[a] = fixed_[b] = 1;
    }

    /// Takes Gauss-Newton steps on all vertices, and reverts those that do not improve the fit.
    void fit_all_vertices(int steps) {
        start_ = positions_;
        guard_.emplace(MeshRef{start_, triangles_}, min_fitted_fold);
        if (error_.empty()) return;
        context_.check_now();
        deviations_ = error_.measure(positions_);
        const std::vector<FaceDeviation> first = deviations_;
        const double before = sum(first).max_squared_distance;
        for (int step = 0; step < steps; ++step) {
            move(gauss_newton_step(triangles_, error_.correspondences(), fixed_, power, context_));
            if (step + 1 < steps) error_.update_correspondences(positions_);
        }
        deviations_ = error_.measure(positions_);
        for (int round = 0; round < max_revert_rounds && revert(first, before); ++round)
            deviations_ = error_.measure(positions_);
        if (!(sum(deviations_).max_squared_distance <= before)) {
            positions_ = start_;
            deviations_ = error_.measure(positions_);
        }
    }

    /// Decreases the maximum distance: takes steps on the vertices around the most distant points only, with
    /// a weighting that emphasizes large distances, as long as this is an improvement.
    /// \pre fit_all_vertices() was called
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
                    before, gauss_newton_step(triangles_, correspondences, fixed, farthest_power, context_)))
                return;
        }
    }

    /// Flips edges where this brings the surfaces closer. Returns the flips.
    /// \pre fit_all_vertices() was called
    std::vector<EdgeFlip> flip_edges(std::span<const Index> groups) {
        if (error_.empty()) return {};
        std::vector<EdgeFlip> flips =
            find_edge_flips({positions_, triangles_, fixed_, groups}, original_, error_.from_reference(),
                            error_.from_reference_vertices(), area(original_.mesh), context_);
        std::vector<std::uint8_t> flipped(triangles_.size(), 0);
        for (const EdgeFlip& flip : flips) {
            flip_edge(triangles_[flip[0]], triangles_[flip[1]]);
            flipped[flip[0]] = flipped[flip[1]] = 1;
        }
        error_.resample_flipped(positions_, flipped);
        return flips;
    }

    std::vector<Vector3> take_positions() { return std::move(positions_); }

private:
    /// Whether the normal deviation has increased, and its square by a larger factor than the squared
    /// distances have decreased.
    static bool is_worse(const FaceDeviation& now, const FaceDeviation& before) {
        return now.normal_deviation > before.normal_deviation &&
               now.squared_distance_sum * now.normal_deviation * now.normal_deviation >
                   before.squared_distance_sum * before.normal_deviation * before.normal_deviation;
    }

    /// Whether the maximum distance has decreased, without too large an increase of the sums.
    static bool has_reduced_max_distance(const FaceDeviation& now, const FaceDeviation& before) {
        if (!(now.max_squared_distance < max_distance_ratio * before.max_squared_distance)) return false;
        const double ratio = std::min(before.max_squared_distance / now.max_squared_distance,
                                      std::numeric_limits<double>::max());
        const double gain = portable_exp(tradeoff_exponent * portable_log(ratio));
        const double normal_deviation_ratio = now.normal_deviation / before.normal_deviation;
        return now.squared_distance_sum <= gain * before.squared_distance_sum &&
               normal_deviation_ratio * normal_deviation_ratio <= gain;
    }

    static FaceDeviation sum(std::span<const FaceDeviation> deviations) {
        FaceDeviation all;
        for (const FaceDeviation& deviation : deviations) all.add(deviation);
        return all;
    }

    /// For each vertex, the total deviation of its faces.
    std::vector<FaceDeviation> around_vertices(std::span<const FaceDeviation> deviations) const {
        std::vector<FaceDeviation> sums(start_.size());
        for (std::size_t f = 0; f < deviations.size(); ++f) {
            if (triangles_[f][0] == no_index) continue;
            for (const Index v : triangles_[f]) sums[v].add(deviations[f]);
        }
        return sums;
    }

    /// For each face, whether it has a vertex that is not fixed.
    std::vector<std::uint8_t> movable_faces(std::span<const std::uint8_t> fixed) const {
        std::vector<std::uint8_t> any(triangles_.size(), 0);
        for (std::size_t f = 0; f < any.size(); ++f) {
            if (triangles_[f][0] == no_index) continue;
            for (const Index v : triangles_[f]) any[f] |= !fixed[v];
        }
        return any;
    }

    /// Moves the vertices by the given steps. Steps are shortened at faces that would become invalid.
    void move(std::vector<Vector3> step) {
        for (std::size_t v = 0; v < step.size(); ++v)
            if (fixed_[v] || !step[v].allFinite()) step[v] = Vector3::Zero();
        std::vector<Vector3> to(positions_.size());
        bool all_good = false;
        for (int round = 0; !all_good; ++round) {
            context_.check_now();
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

    /// Calls visit(triangle) for the faces that have shrunk too much or whose normal deviates too much from
    /// the initial one, and for the faces at edges that were not folded initially and are now.
    template <class Visit>
    void for_each_invalid_face(std::span<const Vector3> positions, Visit&& visit) const {
        for (const Triangle& t : triangles_)
            if (t[0] != no_index && !keeps_orientation(t, positions)) visit(t);
        guard_->for_each_fold(positions, [&](const Triangle& s, const Triangle& t) { visit(s), visit(t); });
    }

    bool keeps_orientation(const Triangle& t, std::span<const Vector3> positions) const {
        const Vector3 before = area_vector(start_, t), after = area_vector(positions, t);
        const double old_norm = before.norm(), new_norm = after.norm();
        return new_norm >= min_fitted_area * old_norm &&
               before.dot(after) >= min_normal_cosine_ * old_norm * new_norm;
    }

    /// Tries the step, half of it and a quarter of it.
    /// \return false, with the positions restored, if none of them is an improvement
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

    /// Moves vertices back to their initial positions: those of faces with distant points that were closer
    /// initially, and those whose faces fit worse than initially.
    /// \param first   initial deviation of each face
    /// \param before  initial square of the maximum distance
    /// \return whether any vertex was moved back
    bool revert(std::span<const FaceDeviation> first, double before) {
        const double limit = revert_share * revert_share * before;
        bool any = false;
        for (std::size_t f = 0; f < deviations_.size(); ++f) {
            const FaceDeviation& deviation = deviations_[f];
            if (deviation.max_squared_distance > limit &&
                deviation.max_squared_distance > first[f].max_squared_distance)
                any |= revert(triangles_[f]);
        }
        const std::vector<FaceDeviation> before_around = around_vertices(first),
                                         around = around_vertices(deviations_);
        for (Index v = 0; v < around.size(); ++v)
            if (is_worse(around[v], before_around[v])) any |= revert(v);
        // Moving back some corners of a face may make it invalid; then all of its corners are moved back.
        for (bool reverted = any; reverted;) {
            reverted = false;
            for_each_invalid_face(positions_, [&](const Triangle& t) { reverted |= revert(t); });
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
    const engine::RunContext& context_;
    ReferenceSurface original_;
    std::vector<Triangle> triangles_;  // of the simplified mesh
    std::vector<Vector3> start_, positions_;
    std::vector<std::uint8_t> fixed_;
    std::optional<FoldGuard> guard_;
    TwoSidedError error_;
    std::vector<FaceDeviation> deviations_;  // of the faces of the simplified mesh
};

FAQEM_INLINE FittingResult fit_vertices(const MeshRef& original, const MeshRef& simplified,
                                        std::span<const std::uint8_t> fixed, double min_normal_cosine,
                                        EdgeFlips flips, std::span<const Index> groups,
                                        const RunContext& context) {
    VertexFitting fitting(original, simplified, fixed, min_normal_cosine, context);
    FittingResult result;
    fitting.fit_all_vertices(first_steps);
    if (flips == EdgeFlips::on) {
        fitting.reduce_max_distance();
        result.flips = fitting.flip_edges(groups);
        fitting.fit_all_vertices(later_steps);
    }
    fitting.reduce_max_distance();
    result.positions = fitting.take_positions();
    return result;
}

FAQEM_DETAIL_END
