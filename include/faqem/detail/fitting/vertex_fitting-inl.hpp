#pragma once

#include "faqem/export.hpp"
#include "faqem/detail/fitting/vertex_fitting.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "faqem/detail/fitting/edge_flip_search.hpp"
#include "faqem/detail/geometry/edge_flip.hpp"
#include "faqem/detail/fitting/gauss_newton.hpp"
#include "faqem/detail/fitting/fold_guard.hpp"
#include "faqem/detail/geometry/halfedges.hpp"
#include "faqem/detail/fitting/two_sided_error.hpp"

FAQEM_NAMESPACE_BEGIN
namespace detail {

using engine::Vector3;

/// Times that edges are swapped, with fewer steps after each.
inline constexpr int swaps = 2;
inline constexpr int first_steps = 4, later_steps = 2;
/// The sum of d^2.5 gets smaller: far points count more, so that the largest distance falls too.
inline constexpr double power = 0.5;
/// Points that end farther away than this share of the farthest at the start go back.
inline constexpr double put_back_from = 0.9;
/// A face may not shrink below this share of its area.
inline constexpr double min_fitted_area = 0.05;
/// The relaxation may not fold the surface at an edge: cosine between the normals.
inline constexpr double min_fitted_fold = -0.9;
/// Times that a step is halved where faces turn too far, before it is left out there.
inline constexpr int halvings = 6;
/// Times that far points are put back before all of them are.
inline constexpr int most_rounds = 6;
/// Times that the farthest points are drawn in; they are those beyond this share of the farthest one; the
/// power of their distance by which they count; the squared distance that counts as nearer; and how much of a
/// factor gained there the sums may lose, as a power of it.
inline constexpr int most_draws = 40;
inline constexpr double draw_from = 0.9, draw_power = 4, least_draw = 0.998, exchange = 0.15;

/// Vertices on edges with one face.
inline std::vector<std::uint8_t> on_border(std::span<const Triangle> triangles, std::size_t vertices, Poll poll) {
    std::vector<std::uint8_t> border(vertices, 0);
    for_each_edge(sorted_sides(triangles, poll), [&](std::span<const Side> on) {
        if (on.size() == 1) border[on[0].low] = border[on[0].high] = 1;
    });
    return border;
}

class Relaxation {
public:
    Relaxation(const Patchwork& original, const Patchwork& light, std::span<const std::uint8_t> fixed,
               double least_turn, Workers workers)
        : least_turn_(least_turn),
          workers_(workers),
          original_(original, workers),
          triangles_(light.triangles.begin(), light.triangles.end()),
          positions_(light.positions.begin(), light.positions.end()),
          fixed_(on_border(light.triangles, positions_.size(), workers.poll)),
          gaps_(original_, triangles_, positions_, workers) {
        for (std::size_t v = 0; v < fixed_.size(); ++v) fixed_[v] |= fixed[v];
    }

    /// Moves the vertices, by steps on all of them.
    void settle(int steps) {
        start_ = positions_;
        guard_.emplace(Patchwork{start_, triangles_}, min_fitted_fold, workers_.poll);
        if (gaps_.empty()) return;
        fits_ = gaps_.measure(positions_);
        const std::vector<Fit> first = fits_;
        const double before = farthest(first);
        for (int step = 0; step < steps; ++step) {
            move(fitting_step(triangles_, gaps_.pulls(), fixed_, power, workers_));
            if (step + 1 < steps) gaps_.measure_pulls(positions_);
        }
        fits_ = gaps_.measure(positions_);
        for (int round = 0; round < most_rounds && put_back(first, before); ++round)
            fits_ = gaps_.measure(positions_);
        if (!(farthest(fits_) <= before)) {
            positions_ = start_;
            fits_ = gaps_.measure(positions_);
        }
    }

    /// Draws in the farthest points: the vertices around them alone take steps that count the far ones most,
    /// as long as that helps. \pre settle()
    void draw_in() {
        if (fits_.empty()) return;
        for (int round = 0; round < most_draws; ++round) {
            const Fit before = sum(fits_);
            std::vector<std::uint8_t> held(start_.size(), 1);
            for (std::size_t f = 0; f < fits_.size(); ++f) {
                if (!(fits_[f].farthest > draw_from * draw_from * before.farthest)) continue;
                for (const Index v : triangles_[f]) held[v] = fixed_[v];
            }
            const std::vector<Pull> pulls = gaps_.pulls_at(faces_that_move(held));
            if (!draw_in(before, fitting_step(triangles_, pulls, held, draw_power, workers_))) return;
        }
    }

    /// Swaps edges where that helps. \pre settle()
    std::vector<EdgeSwap> swap_edges(std::span<const Index> groups) {
        if (gaps_.empty()) return {};
        std::vector<EdgeSwap> better =
            better_edges({positions_, triangles_, fixed_, groups}, original_, gaps_.back(), gaps_.corners(),
                         area(original_.mesh), workers_);
        std::vector<std::uint8_t> swapped(triangles_.size(), 0);
        for (const EdgeSwap& swap : better) {
            swap_edge(triangles_[swap[0]], triangles_[swap[1]]);
            swapped[swap[0]] = swapped[swap[1]] = 1;
        }
        gaps_.swap(positions_, swapped);
        return better;
    }

    std::vector<Vector3> take_positions() { return std::move(positions_); }

private:
    /// A gain in distance at the cost of the normals is none, unless it is the larger one.
    static bool is_worse(const Fit& now, const Fit& before) {
        return now.turn > before.turn &&
               now.distance * now.turn * now.turn > before.distance * before.turn * before.turn;
    }

    /// Is the farthest nearer, and do the sums lose less than it gains?
    static bool is_drawn_in(const Fit& now, const Fit& before) {
        if (!(now.farthest < least_draw * before.farthest)) return false;
        const double gain = std::pow(before.farthest / now.farthest, exchange);
        const double lost_turn = now.turn / before.turn;
        return now.distance <= gain * before.distance && lost_turn * lost_turn <= gain;
    }

    static Fit sum(std::span<const Fit> fits) {
        Fit all;
        for (const Fit& fit : fits) all.add(fit);
        return all;
    }

    static double farthest(std::span<const Fit> fits) { return sum(fits).farthest; }

    /// Of the faces around each vertex together.
    std::vector<Fit> around_vertices(std::span<const Fit> fits) const {
        std::vector<Fit> sums(start_.size());
        for (std::size_t f = 0; f < fits.size(); ++f) {
            workers_.poll();
            if (triangles_[f][0] == no_index) continue;
            for (const Index v : triangles_[f]) sums[v].add(fits[f]);
        }
        return sums;
    }

    /// Those with a vertex that is not held.
    std::vector<std::uint8_t> faces_that_move(std::span<const std::uint8_t> held) const {
        std::vector<std::uint8_t> any(triangles_.size(), 0);
        for (std::size_t f = 0; f < any.size(); ++f) {
            workers_.poll();
            if (triangles_[f][0] == no_index) continue;
            for (const Index v : triangles_[f]) any[f] |= !held[v];
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
            for_each_bad_face(to, [&](const Triangle& t) {
                for (const Index v : t) {
                    if (step[v].isZero(0)) continue;
                    step[v] *= round < halvings ? 0.5 : 0.0;
                    all_good = false;
                }
            });
        }
        positions_ = std::move(to);
    }

    /// Faces that have turned too far, or look away from a neighbour that they did not look away from.
    template <class Visit>
    void for_each_bad_face(std::span<const Vector3> positions, Visit&& visit) const {
        for (const Triangle& t : triangles_) {
            workers_.poll();
            if (t[0] != no_index && !keeps_its_side(t, positions)) visit(t);
        }
        guard_->for_each_fold(
            positions, [&](const Triangle& s, const Triangle& t) { visit(s), visit(t); }, workers_.poll);
    }

    bool keeps_its_side(const Triangle& t, std::span<const Vector3> positions) const {
        const Vector3 before = area_vector(start_, t), after = area_vector(positions, t);
        const double old_norm = before.norm(), new_norm = after.norm();
        return new_norm >= min_fitted_area * old_norm && before.dot(after) >= least_turn_ * old_norm * new_norm;
    }

    /// False, and all is as it was: neither the step nor its half or quarter helps.
    bool draw_in(const Fit& before, std::vector<Vector3> step) {
        const std::vector<Vector3> from = positions_;
        for (int half = 0; half < 3; ++half) {
            move(step);
            fits_ = gaps_.measure_again(positions_);
            if (is_drawn_in(sum(fits_), before)) return true;
            positions_ = from;
            for (Vector3& s : step) s *= 0.5;
        }
        fits_ = gaps_.measure_again(positions_);
        return false;
    }

    /// Undoes the moves at faces with far points that were nearer before, and of vertices around which the
    /// faces fit worse than before. False: there were none.
    bool put_back(std::span<const Fit> first, double before) {
        const double limit = put_back_from * put_back_from * before;
        bool any = false;
        for (std::size_t f = 0; f < fits_.size(); ++f) {
            workers_.poll();
            const Fit& fit = fits_[f];
            if (fit.farthest > limit && fit.farthest > first[f].farthest) any |= put_back(triangles_[f]);
        }
        const std::vector<Fit> before_around = around_vertices(first), around = around_vertices(fits_);
        for (Index v = 0; v < around.size(); ++v) {
            if (is_worse(around[v], before_around[v])) any |= put_back(v);
        }
        // A face with some of its corners back may have turned: then all of them go back.
        for (bool turned = any; turned;) {
            turned = false;
            for_each_bad_face(positions_, [&](const Triangle& t) { turned |= put_back(t); });
        }
        return any;
    }

    bool put_back(const Triangle& t) {
        bool any = false;
        for (const Index v : t) any |= put_back(v);
        return any;
    }

    bool put_back(Index v) {
        if (positions_[v] == start_[v]) return false;
        positions_[v] = start_[v];
        return true;
    }

    double least_turn_;
    Workers workers_;
    StillSurface original_;
    std::vector<Triangle> triangles_;  // of the light mesh
    std::vector<Vector3> start_, positions_;
    std::vector<std::uint8_t> fixed_;
    std::optional<FoldGuard> guard_;
    TwoSidedGaps gaps_;
    std::vector<Fit> fits_;  // of the faces of the light mesh
};

FAQEM_INLINE std::vector<Vector3> relax(const Patchwork& original, const Patchwork& light,
                           std::span<const std::uint8_t> fixed, double least_turn, Workers workers) {
    Relaxation relaxation(original, light, fixed, least_turn, workers);
    relaxation.settle(first_steps);
    relaxation.draw_in();
    return relaxation.take_positions();
}

FAQEM_INLINE Relaxed relax_and_swap(const Patchwork& original, const Patchwork& light, std::span<const std::uint8_t> fixed,
                       std::span<const Index> groups, double least_turn, Workers workers) {
    Relaxation relaxation(original, light, fixed, least_turn, workers);
    Relaxed result;
    relaxation.settle(first_steps);
    for (int round = 0; round < swaps; ++round) {
        relaxation.draw_in();
        const std::vector<EdgeSwap> better = relaxation.swap_edges(groups);
        result.swaps.insert(result.swaps.end(), better.begin(), better.end());
        relaxation.settle(later_steps);
    }
    relaxation.draw_in();
    result.positions = relaxation.take_positions();
    return result;
}

}  // namespace detail
FAQEM_NAMESPACE_END
