#include "gaps.hpp"

#include <cmath>

#include "parallel.hpp"
#include "surface.hpp"

namespace faqem::detail {

namespace {

using engine::Vector3;

constexpr std::size_t block = 1024;

/// The point of a mesh closest to p.
/// \param last  the face where it was not long ago, or no_index
Bvh::Hit nearest(const Bvh& tree, const Patchwork& mesh, const Vector3& p, Index last) {
    if (last == no_index) return tree.closest(engine::to_array(p));
    const Triangle& t = mesh.triangles[last];
    return tree.closest_from(engine::to_array(p), last, mesh.positions[t[0]], mesh.positions[t[1]],
                             mesh.positions[t[2]]);
}

/// Of each triangle: has it a corner that is not where it was? All of them where nothing was before.
std::vector<std::uint8_t> moved_triangles(std::span<const Triangle> triangles, std::span<const Vector3> from,
                                          std::span<const Vector3> to) {
    std::vector<std::uint8_t> moved(triangles.size(), 0);
    for (std::size_t f = 0; f < triangles.size(); ++f) {
        if (triangles[f][0] == no_index) continue;
        for (const Index v : triangles[f]) moved[f] |= from.empty() || from[v] != to[v];
    }
    return moved;
}

}  // namespace

void GapsThere::move_to(std::span<const Vector3> positions, std::uint32_t threads) {
    const std::vector<std::uint8_t> moved = moved_triangles(triangles_, positions_, positions);
    positions_.assign(positions.begin(), positions.end());
    parallel_blocks(spots_.size(), block, threads, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            if (moved[spots_[i].face]) measure(i);
        }
    });
}

void GapsThere::measure(std::size_t i) {
    const Vector3 p = spots_[i].on(positions_, triangles_);
    const Bvh::Hit hit = nearest(original_.tree, original_.mesh, p, gaps_[i].face);
    gaps_[i] = {engine::to_eigen(hit.point) - p, hit.face, -1};
}

Vector3 GapsThere::normal(std::size_t i) const {
    return area_vector(positions_, triangles_[spots_[i].face]).normalized();
}

Pull GapsThere::pull(std::size_t i) const { return {spots_[i], gaps_[i].gap, normal(i)}; }

void GapsThere::measure_turns(double tolerance, std::uint32_t threads) {
    parallel_blocks(spots_.size(), block, threads, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            Gap& gap = gaps_[i];
            if (!(gap.turn < 0)) continue;
            const Vector3 p = spots_[i].on(positions_, triangles_);
            Bvh::Hit hit;
            hit.face = gap.face;
            hit.distance_squared = gap.gap.squaredNorm();
            const double cosine = best_cosine(original_.tree, original_.normals, engine::to_array(p), hit,
                                              normal(i), tolerance);
            gap.turn = std::sqrt(2 - 2 * cosine);
        }
    });
}

void GapsBack::move_to(std::span<const Vector3> positions, std::uint32_t threads,
                       std::span<const std::uint8_t> swapped) {
    std::vector<std::uint8_t> moved = moved_triangles(triangles_, positions_, positions);
    for (std::size_t f = 0; f < swapped.size(); ++f) moved[f] |= swapped[f];
    positions_.assign(positions.begin(), positions.end());
    if (tree_) {
        tree_->refit(positions_, triangles_);
    } else {
        tree_.emplace(positions_, triangles_);
    }
    std::vector<Triangle> those_moved(triangles_.begin(), triangles_.end());
    for (std::size_t f = 0; f < moved.size(); ++f) {
        if (!moved[f]) those_moved[f].fill(no_index);
    }
    const Bvh moved_tree(positions_, those_moved);
    parallel_blocks(points_.size(), block, threads, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const Vector3& p = points_[i].position;
            const Index last = gaps_[i].spot.face;
            Bvh::Hit hit;
            if (last == no_index || moved[last]) {
                hit = nearest(*tree_, {positions_, triangles_}, p, last);
            } else {  // what has not moved is as far away as it was
                const double distance = gaps_[i].gap.squaredNorm();
                hit = moved_tree.closest(engine::to_array(p), distance);
                if (hit.face == no_index || (hit.distance_squared == distance && hit.face > last)) continue;
            }
            gaps_[i] = {{hit.face, hit.barycentric}, p - engine::to_eigen(hit.point)};
        }
    });
}

}  // namespace faqem::detail
