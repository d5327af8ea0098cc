#include "relax.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "bvh.hpp"
#include "fit.hpp"
#include "parallel.hpp"
#include "surface.hpp"

namespace faqem::detail {

namespace {

using engine::Vector3;

constexpr std::size_t block = 1024;
constexpr int steps = 4;
constexpr std::size_t points_per_face = 10, least_points = 5000, most_points = 2'000'000;
/// Points that end farther away than this share of the farthest at the start go back.
constexpr double put_back_from = 0.9;
/// Added to each point's distance between the normals: a fraction of a degree does not matter.
constexpr double least_turn_counted = 0.005;
/// Original faces whose distances differ by less are tied. The diagonal is 1.
constexpr double tie_tolerance = 1e-9;
/// A face may not shrink below this share of its area.
constexpr double least_area = 0.05;
/// Times that a step is halved where faces turn too far, before it is left out there.
constexpr int halvings = 6;
/// Times that far points are put back before all of them are.
constexpr int most_rounds = 6;

Vector3 area_vector(std::span<const Vector3> x, const Triangle& t) {
    return engine::area_vector(x[t[0]], x[t[1]], x[t[2]]);
}

Vector3 unit(const Vector3& n) {
    const double length = n.norm();
    return length > 0 ? Vector3(n / length) : Vector3(Vector3::Zero());
}

/// A point of the original and the unit normal there. Planes are those of the point's own surface: where the
/// closest face of the other surface is one of several, its plane would be chance.
struct Point {
    Vector3 position, normal;
};

/// The k-th point of a sequence that fills the triangle evenly (Roberts 2018, with the plastic number).
Vec3 even_weight(std::size_t k) {
    const auto fraction = [&](double step) {
        const double x = 0.5 + step * static_cast<double>(k);
        return x - std::floor(x);
    };
    double v = fraction(0.75487766624669276), w = fraction(0.56984029099805327);
    if (v + w > 1) v = 1 - v, w = 1 - w;
    return {1 - v - w, v, w};
}

/// `count` points spread by area.
std::vector<Spot> spread(const Patchwork& mesh, std::size_t count) {
    std::vector<double> area_up_to;
    double area = 0;
    for (const Triangle& t : mesh.triangles) {
        if (t[0] != no_index) area += area_vector(mesh.positions, t).norm();
        area_up_to.push_back(area);
    }
    std::vector<Spot> spots;
    if (!(area > 0)) return spots;
    Index face = 0;
    for (std::size_t k = 0; k < count; ++k) {
        const double place = (static_cast<double>(k) + 0.5) / static_cast<double>(count) * area;
        while (face + 1 < area_up_to.size() && !(area_up_to[face] > place)) ++face;
        spots.push_back({face, even_weight(k)});
    }
    return spots;
}

/// Vertices and middles of edges, each at least once: where the light mesh sticks out.
std::vector<Spot> corners_and_middles(const Patchwork& mesh) {
    std::vector<Spot> spots;
    std::vector<std::uint8_t> seen(mesh.positions.size(), 0);
    for (Index f = 0; f < mesh.triangles.size(); ++f) {
        const Triangle& t = mesh.triangles[f];
        if (t[0] == no_index) continue;
        for (std::size_t k = 0; k < 3; ++k) {
            Spot corner{f, {0, 0, 0}};
            corner.weight[k] = 1;
            if (!std::exchange(seen[t[k]], std::uint8_t{1})) spots.push_back(corner);
            corner.weight[k] = corner.weight[(k + 1) % 3] = 0.5;
            spots.push_back(corner);
        }
    }
    return spots;
}

/// Vertices on edges with one face.
std::vector<std::uint8_t> on_border(std::span<const Triangle> triangles, std::size_t vertices) {
    std::vector<std::pair<Index, Index>> edges;
    for (const Triangle& t : triangles) {
        if (t[0] == no_index) continue;
        for (std::size_t k = 0; k < 3; ++k) edges.push_back(std::minmax(t[k], t[(k + 1) % 3]));
    }
    std::sort(edges.begin(), edges.end());
    std::vector<std::uint8_t> border(vertices, 0);
    for (std::size_t i = 0; i < edges.size();) {
        std::size_t end = i + 1;
        while (end < edges.size() && edges[end] == edges[i]) ++end;
        if (end == i + 1) border[edges[i].first] = border[edges[i].second] = 1;
        i = end;
    }
    return border;
}

class Relaxation {
public:
    Relaxation(const Patchwork& original, const Patchwork& light, std::span<const std::uint8_t> fixed,
               double least_turn, std::uint32_t threads)
        : original_(original),
          light_(light),
          least_turn_(least_turn),
          threads_(threads),
          original_tree_(original.positions, original.triangles),
          start_(light.positions.begin(), light.positions.end()),
          positions_(start_),
          fixed_(on_border(light.triangles, start_.size())) {
        for (std::size_t v = 0; v < fixed_.size(); ++v) fixed_[v] |= fixed[v];
        const std::size_t faces =
            static_cast<std::size_t>(std::count_if(light.triangles.begin(), light.triangles.end(),
                                                   [](const Triangle& t) { return t[0] != no_index; }));
        const std::size_t count = std::clamp(points_per_face * faces, least_points, most_points);
        for (const Triangle& t : original.triangles) {
            original_normals_.push_back(t[0] == no_index ? Vector3::Zero()
                                                         : unit(area_vector(original.positions, t)));
        }
        spots_ = spread(light, count);
        for (const Spot& spot : corners_and_middles(light)) spots_.push_back(spot);
        add_original_vertices(4 * count);
        for (const Spot& spot : spread(original, count)) {
            original_points_.push_back(
                {spot.on(original.positions, original.triangles), original_normals_[spot.face]});
        }
    }

    std::vector<Vector3> operator()() {
        if (spots_.empty() || original_points_.empty()) return start_;
        measure();
        const std::vector<Fit> first = fits_;
        const double before = farthest(first);
        for (int step = 0; step < steps; ++step) {
            move(fitting_step(light_.triangles, pulls_, fixed_));
            measure();
        }
        for (int round = 0; round < most_rounds && put_back(first, before); ++round) measure();
        return farthest(fits_) <= before ? positions_ : start_;
    }

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
    };

    static double farthest(std::span<const Fit> fits) {
        Fit all;
        for (const Fit& fit : fits) all.add(fit);
        return all.farthest;
    }

    /// Of the faces around each vertex together.
    std::vector<Fit> around_vertices(std::span<const Fit> fits) const {
        std::vector<Fit> sums(start_.size());
        for (std::size_t f = 0; f < fits.size(); ++f) {
            if (light_.triangles[f][0] == no_index) continue;
            for (const Index v : light_.triangles[f]) sums[v].add(fits[f]);
        }
        return sums;
    }

    /// With the mean normal of the faces around each; none if there are more than `most`.
    void add_original_vertices(std::size_t most) {
        std::vector<Vector3> normal(original_.positions.size(), Vector3::Zero());
        std::vector<std::uint8_t> used(original_.positions.size(), 0);
        for (const Triangle& t : original_.triangles) {
            if (t[0] == no_index) continue;
            const Vector3 n = area_vector(original_.positions, t);
            for (const Index v : t) normal[v] += n, used[v] = 1;
        }
        const auto count = static_cast<std::size_t>(std::count(used.begin(), used.end(), 1));
        for (std::size_t v = 0; v < used.size() && count <= most; ++v) {
            if (used[v]) original_points_.push_back({original_.positions[v], unit(normal[v])});
        }
    }

    /// Finds the pulls of all points where the vertices are now, and how well the faces fit.
    void measure() {
        pulls_.resize(spots_.size() + original_points_.size());
        std::vector<double> turn(spots_.size());
        parallel_blocks(spots_.size(), block, threads_, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) {
                const Vector3 p = spots_[i].on(positions_, light_.triangles);
                const Bvh::Hit hit = original_tree_.closest(engine::to_array(p));
                pulls_[i] = {spots_[i], engine::to_eigen(hit.point) - p,
                             unit(area_vector(positions_, light_.triangles[spots_[i].face]))};
                const double cosine = best_cosine(original_tree_, original_normals_, engine::to_array(p), hit,
                                                  pulls_[i].normal, tie_tolerance);
                turn[i] = least_turn_counted + std::sqrt(2 - 2 * cosine);
            }
        });
        const Bvh tree(positions_, light_.triangles);
        parallel_blocks(original_points_.size(), block, threads_, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) {
                const Vector3& p = original_points_[i].position;
                const Bvh::Hit hit = tree.closest(engine::to_array(p));
                pulls_[spots_.size() + i] = {
                    {hit.face, hit.barycentric}, p - engine::to_eigen(hit.point), original_points_[i].normal};
            }
        });
        fits_.assign(light_.triangles.size(), {});
        for (const Pull& pull : pulls_) {
            const double distance = pull.gap.squaredNorm();
            fits_[pull.spot.face].add({distance, distance, 0});
        }
        for (std::size_t i = 0; i < turn.size(); ++i) fits_[spots_[i].face].turn += turn[i];
    }

    /// Takes the steps, shorter where a face would turn too far from where it was at the start.
    void move(std::vector<Vector3> step) {
        for (std::size_t v = 0; v < step.size(); ++v) {
            if (fixed_[v] || !step[v].allFinite()) step[v] = Vector3::Zero();
        }
        bool all_good = false;
        for (int round = 0; !all_good; ++round) {
            all_good = true;
            for (const Triangle& t : light_.triangles) {
                if (t[0] == no_index || keeps_its_side(t, step)) continue;
                all_good = false;
                for (const Index v : t) step[v] *= round < halvings ? 0.5 : 0.0;
            }
        }
        for (std::size_t v = 0; v < step.size(); ++v) positions_[v] += step[v];
    }

    bool keeps_its_side(const Triangle& t, std::span<const Vector3> step) const {
        const Vector3 before = area_vector(start_, t);
        const Vector3 after = engine::area_vector(
            positions_[t[0]] + step[t[0]], positions_[t[1]] + step[t[1]], positions_[t[2]] + step[t[2]]);
        const double old_norm = before.norm(), new_norm = after.norm();
        return new_norm >= least_area * old_norm && before.dot(after) >= least_turn_ * old_norm * new_norm;
    }

    /// Undoes the moves at faces with far points that were nearer before, and of vertices around which the
    /// faces fit worse than before. False: there were none.
    bool put_back(std::span<const Fit> first, double before) {
        const double limit = put_back_from * put_back_from * before;
        bool any = false;
        for (std::size_t f = 0; f < fits_.size(); ++f) {
            const Fit& fit = fits_[f];
            if (fit.farthest > limit && fit.farthest > first[f].farthest)
                any |= put_back(light_.triangles[f]);
        }
        const std::vector<Fit> before_around = around_vertices(first), around = around_vertices(fits_);
        for (Index v = 0; v < around.size(); ++v) {
            if (around[v].is_worse_than(before_around[v])) any |= put_back(v);
        }
        // A face with some of its corners back may have turned: then all of them go back.
        const std::vector<Vector3> nowhere(positions_.size(), Vector3::Zero());
        for (bool turned = any; turned;) {
            turned = false;
            for (const Triangle& t : light_.triangles) {
                if (t[0] != no_index && !keeps_its_side(t, nowhere)) turned |= put_back(t);
            }
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

    const Patchwork& original_;
    const Patchwork& light_;
    double least_turn_;
    std::uint32_t threads_;
    Bvh original_tree_;
    std::vector<Vector3> start_, positions_;
    std::vector<std::uint8_t> fixed_;
    std::vector<Spot> spots_;             // points of the light mesh
    std::vector<Point> original_points_;  // of the original
    std::vector<Pull> pulls_;             // of spots_, then of original_points_
    std::vector<Fit> fits_;               // of the faces of the light mesh
    std::vector<Vector3> original_normals_;
};

}  // namespace

std::vector<Vector3> relax(const Patchwork& original, const Patchwork& light,
                           std::span<const std::uint8_t> fixed, double least_turn, std::uint32_t threads) {
    return Relaxation(original, light, fixed, least_turn, threads)();
}

}  // namespace faqem::detail
