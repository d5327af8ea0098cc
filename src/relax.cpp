#include "relax.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "better_edges.hpp"
#include "edge_swap.hpp"
#include "fit.hpp"
#include "fold_guard.hpp"
#include "gaps.hpp"
#include "parallel.hpp"
#include "sides.hpp"
#include "spots.hpp"

namespace faqem::detail {

namespace {

using engine::Vector3;

/// Times that edges are swapped, with fewer steps after each.
constexpr int swaps = 2;
constexpr int first_steps = 4, later_steps = 2;
/// The sum of d^2.5 gets smaller: far points count more, so that the largest distance falls too.
constexpr double power = 0.5;
constexpr std::size_t points_per_face = 10, least_points = 5000, most_points = 2'000'000;
/// The original has more that could be missed: so many times as many points there.
constexpr std::size_t more_back = 2;
/// Points that end farther away than this share of the farthest at the start go back.
constexpr double put_back_from = 0.9;
/// Added to each point's distance between the normals: a fraction of a degree does not matter.
constexpr double least_turn_counted = 0.005;
/// Original faces whose distances differ by less are tied. The diagonal is 1.
constexpr double tie_tolerance = 1e-9;
/// A face may not shrink below this share of its area.
constexpr double least_area = 0.05;
/// The relaxation may not fold the surface at an edge: cosine between the normals.
constexpr double least_fold = -0.9;
/// Times that a step is halved where faces turn too far, before it is left out there.
constexpr int halvings = 6;
/// Times that far points are put back before all of them are.
constexpr int most_rounds = 6;
/// Times that the farthest points are drawn in; they are those beyond this share of the farthest one; the
/// power of their distance by which they count; the squared distance that counts as nearer; and how much of a
/// factor gained there the sums may lose, as a power of it.
constexpr int most_draws = 40;
constexpr double draw_from = 0.9, draw_power = 4, least_draw = 0.998, exchange = 0.15;

/// Vertices on edges with one face.
std::vector<std::uint8_t> on_border(std::span<const Triangle> triangles, std::size_t vertices) {
    std::vector<std::uint8_t> border(vertices, 0);
    for_each_edge(sorted_sides(triangles), [&](std::span<const Side> on) {
        if (on.size() == 1) border[on[0].low] = border[on[0].high] = 1;
    });
    return border;
}

double area(const Patchwork& mesh) {
    double twice = 0;
    for (const Triangle& t : mesh.triangles) {
        if (t[0] != no_index) twice += area_vector(mesh.positions, t).norm();
    }
    return twice / 2;
}

class Relaxation {
public:
    Relaxation(const Patchwork& original, const Patchwork& light, std::span<const std::uint8_t> fixed,
               double least_turn, std::uint32_t threads)
        : least_turn_(least_turn),
          threads_(threads),
          original_(original),
          triangles_(light.triangles.begin(), light.triangles.end()),
          positions_(light.positions.begin(), light.positions.end()),
          fixed_(on_border(light.triangles, positions_.size())),
          there_(original_, triangles_, evenly_spread(light, point_count(light))),
          back_(even_points(), triangles_),
          corners_(oriented_vertices(original), triangles_) {
        for (std::size_t v = 0; v < fixed_.size(); ++v) fixed_[v] |= fixed[v];
    }

    /// Moves the vertices, by steps on all of them.
    void settle(int steps) {
        start_ = positions_;
        guard_.emplace(Patchwork{start_, triangles_}, least_fold);
        ends_.emplace(original_, triangles_, corners_and_middles(triangles_));
        if (there_.size() == 0 || back_.size() == 0) return;
        measure();
        const std::vector<Fit> first = fits_;
        const double before = farthest(first);
        for (int step = 0; step < steps; ++step) {
            move(fitting_step(triangles_, pulls(), fixed_, power, threads_));
            if (step + 1 < steps) measure_pulls();
        }
        measure();
        for (int round = 0; round < most_rounds && put_back(first, before); ++round) measure();
        if (!(farthest(fits_) <= before)) {
            positions_ = start_;
            measure();
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
            if (!draw_in(before, fitting_step(triangles_, pulls_around(held), held, draw_power, threads_)))
                return;
        }
    }

    /// Swaps edges where that helps. \pre settle()
    std::vector<EdgeSwap> swap_edges(std::span<const Index> groups) {
        if (there_.size() == 0 || back_.size() == 0) return {};
        const std::vector<EdgeSwap> better = better_edges({positions_, triangles_, fixed_, groups}, original_,
                                                          back_, corners_, area(original_.mesh), threads_);
        std::vector<std::uint8_t> swapped(triangles_.size(), 0);
        for (const EdgeSwap& swap : better) {
            swap_edge(triangles_[swap[0]], triangles_[swap[1]]);
            swapped[swap[0]] = swapped[swap[1]] = 1;
        }
        there_.replace(swapped, spots_on(swapped));
        back_.move_to(positions_, threads_, swapped);
        corners_.move_to(positions_, threads_, swapped);
        return better;
    }

    std::vector<Vector3> take_positions() { return std::move(positions_); }

private:
    /// How well faces of the light mesh fit.
    struct Fit {
        double farthest = 0;  ///< largest squared distance of their points
        double distance = 0;  ///< sum of these squared distances
        double turn = 0;      ///< sum of the distances between the unit normals on either side
        void add(const Fit& other) {
            farthest = std::max(farthest, other.farthest);
            distance += other.distance;
            turn += other.turn;
        }
        /// A gain in distance at the cost of the normals is none, unless it is the larger one.
        bool is_worse_than(const Fit& other) const {
            return turn > other.turn && distance * turn * turn > other.distance * other.turn * other.turn;
        }
        /// Is the farthest nearer, and do the sums lose less than it gains?
        bool is_drawn_in_from(const Fit& other) const {
            if (!(farthest < least_draw * other.farthest)) return false;
            const double gain = std::pow(other.farthest / farthest, exchange);
            const double lost_turn = turn / other.turn;
            return distance <= gain * other.distance && lost_turn * lost_turn <= gain;
        }
    };

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
            if (triangles_[f][0] == no_index) continue;
            for (const Index v : triangles_[f]) sums[v].add(fits[f]);
        }
        return sums;
    }

    static std::size_t point_count(const Patchwork& light) {
        const auto faces = std::count_if(light.triangles.begin(), light.triangles.end(),
                                         [](const Triangle& t) { return t[0] != no_index; });
        return std::clamp(points_per_face * static_cast<std::size_t>(faces), least_points, most_points);
    }

    /// On some faces, as close together as those on the whole mesh.
    std::vector<Spot> spots_on(std::span<const std::uint8_t> faces) const {
        std::vector<Triangle> those(triangles_);
        for (std::size_t f = 0; f < those.size(); ++f) {
            if (!faces[f]) those[f].fill(no_index);
        }
        const double share = area({positions_, those}) / area({positions_, triangles_});
        const auto count = std::llround(share * static_cast<double>(point_count({positions_, triangles_})));
        return evenly_spread({positions_, those}, static_cast<std::size_t>(count));
    }

    std::vector<OrientedPoint> even_points() const {
        std::vector<OrientedPoint> points;
        for (const Spot& spot :
             evenly_spread(original_.mesh, more_back * point_count({positions_, triangles_}))) {
            points.push_back(
                {spot.on(original_.mesh.positions, original_.mesh.triangles), original_.normals[spot.face]});
        }
        return points;
    }

    /// All of them but those of the vertices. Valid until the next call.
    std::span<const Pull> pulls() {
        pulls_.resize(there_.size() + ends_->size() + back_.size());
        std::size_t begin = 0;
        const auto add = [&](const auto& gaps) {
            parallel_blocks(gaps.size(), 4096, threads_, [&](std::size_t from, std::size_t to) {
                for (std::size_t i = from; i < to; ++i) pulls_[begin + i] = gaps.pull(i);
            });
            begin += gaps.size();
        };
        add(there_), add(*ends_), add(back_);
        return pulls_;
    }

    void measure_pulls() {
        there_.move_to(positions_, threads_);
        ends_->move_to(positions_, threads_);
        back_.move_to(positions_, threads_);
    }

    /// Finds how well the faces fit where the vertices are now.
    void measure() {
        measure_pulls();
        there_.measure_turns(tie_tolerance, threads_);
        ends_->measure_turns(tie_tolerance, threads_);
        corners_.move_to(positions_, threads_);
        fits_.assign(triangles_.size(), {});
        for (const GapsThere* there : {&there_, &*ends_}) {
            for (std::size_t i = 0; i < there->size(); ++i) {
                const double distance = there->gap(i).squaredNorm();
                fits_[there->spot(i).face].add({distance, distance, least_turn_counted + there->turn(i)});
            }
        }
        for (std::size_t i = 0; i < back_.size(); ++i) {
            const double distance = back_.gap(i).squaredNorm();
            fits_[back_.spot(i).face].add({distance, distance, 0});
        }
        for (std::size_t i = 0; i < corners_.size(); ++i) {
            fits_[corners_.spot(i).face].add({corners_.gap(i).squaredNorm(), 0, 0});
        }
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
            if (t[0] != no_index && !keeps_its_side(t, positions)) visit(t);
        }
        guard_->for_each_fold(positions, [&](const Triangle& s, const Triangle& t) { visit(s), visit(t); });
    }

    bool keeps_its_side(const Triangle& t, std::span<const Vector3> positions) const {
        const Vector3 before = area_vector(start_, t), after = area_vector(positions, t);
        const double old_norm = before.norm(), new_norm = after.norm();
        return new_norm >= least_area * old_norm && before.dot(after) >= least_turn_ * old_norm * new_norm;
    }

    /// False, and all is as it was: neither the step nor its half or quarter helps.
    bool draw_in(const Fit& before, std::vector<Vector3> step) {
        const std::vector<Vector3> from = positions_;
        for (int half = 0; half < 3; ++half) {
            move(step);
            measure();
            if (sum(fits_).is_drawn_in_from(before)) return true;
            positions_ = from;
            for (Vector3& s : step) s *= 0.5;
        }
        measure();
        return false;
    }

    /// Of faces with a vertex that is not held.
    std::vector<Pull> pulls_around(std::span<const std::uint8_t> held) const {
        std::vector<std::uint8_t> counts(triangles_.size(), 0);
        for (std::size_t f = 0; f < counts.size(); ++f) {
            if (triangles_[f][0] == no_index) continue;
            for (const Index v : triangles_[f]) counts[f] |= !held[v];
        }
        std::vector<Pull> all;
        const auto add = [&](const auto& gaps) {
            for (std::size_t i = 0; i < gaps.size(); ++i) {
                if (counts[gaps.spot(i).face]) all.push_back(gaps.pull(i));
            }
        };
        add(there_);
        add(*ends_);
        add(back_);
        add(corners_);
        return all;
    }

    /// Undoes the moves at faces with far points that were nearer before, and of vertices around which the
    /// faces fit worse than before. False: there were none.
    bool put_back(std::span<const Fit> first, double before) {
        const double limit = put_back_from * put_back_from * before;
        bool any = false;
        for (std::size_t f = 0; f < fits_.size(); ++f) {
            const Fit& fit = fits_[f];
            if (fit.farthest > limit && fit.farthest > first[f].farthest) any |= put_back(triangles_[f]);
        }
        const std::vector<Fit> before_around = around_vertices(first), around = around_vertices(fits_);
        for (Index v = 0; v < around.size(); ++v) {
            if (around[v].is_worse_than(before_around[v])) any |= put_back(v);
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
    std::uint32_t threads_;
    StillSurface original_;
    std::vector<Triangle> triangles_;  // of the light mesh
    std::vector<Vector3> start_, positions_;
    std::vector<std::uint8_t> fixed_;
    std::optional<FoldGuard> guard_;
    GapsThere there_;                // from points spread by area
    std::optional<GapsThere> ends_;  // from corners and middles of edges
    GapsBack back_;                  // from points spread by area: they pull, and say how well the faces fit
    GapsBack corners_;               // from the vertices: among them are the farthest points
    std::vector<Pull> pulls_;
    std::vector<Fit> fits_;  // of the faces of the light mesh
};

}  // namespace

std::vector<Vector3> relax(const Patchwork& original, const Patchwork& light,
                           std::span<const std::uint8_t> fixed, double least_turn, std::uint32_t threads) {
    Relaxation relaxation(original, light, fixed, least_turn, threads);
    relaxation.settle(first_steps);
    relaxation.draw_in();
    return relaxation.take_positions();
}

Relaxed relax_and_swap(const Patchwork& original, const Patchwork& light, std::span<const std::uint8_t> fixed,
                       std::span<const Index> groups, double least_turn, std::uint32_t threads) {
    Relaxation relaxation(original, light, fixed, least_turn, threads);
    Relaxed result;
    relaxation.settle(first_steps);
    for (int round = 0; round < swaps; ++round) {
        const std::vector<EdgeSwap> better = relaxation.swap_edges(groups);
        result.swaps.insert(result.swaps.end(), better.begin(), better.end());
        relaxation.settle(later_steps);
    }
    relaxation.draw_in();
    result.positions = relaxation.take_positions();
    return result;
}

}  // namespace faqem::detail
