#pragma once

#include "faqem/export.hpp"
#include "faqem/detail/fitting/closest_point_tracker.hpp"

#include <algorithm>
#include <cmath>

#include "faqem/detail/base/parallel.hpp"
#include "faqem/detail/geometry/surface.hpp"

FAQEM_NAMESPACE_BEGIN
namespace detail {

using engine::Vector3;

/// So many points go together; the first of them is looked for without knowing one before it.
inline constexpr std::size_t block = 1024;
/// Cosine. Inside of a face that looks about the same way another one that is as near would lie upon it, and
/// have the same normal.
inline constexpr double surely_alone = 0.5;

/// Weight of a corner: a point with less of it lies on the side across, but for rounding.
inline constexpr double at_side = 1e-9;
inline constexpr std::uint8_t inside = 3;
/// Share of the squared distance: what is nearer by less is so by chance.
inline constexpr double nearer_by = 1 - 1e-12;

/// The point of a mesh closest to p.
/// \param near  a face that is thought to be near, or no_index
inline Bvh::Hit nearest(const Bvh& tree, const Patchwork& mesh, const Vector3& p, Index near) {
    if (near == no_index) return tree.closest(engine::to_array(p));
    const Triangle& t = mesh.triangles[near];
    return tree.closest_from(engine::to_array(p), near, mesh.positions[t[0]], mesh.positions[t[1]],
                             mesh.positions[t[2]]);
}

/// The corner nearest to a point of a face, or `inside` where the point is on no side.
inline std::uint8_t corner_by(const Vec3& weight) {
    if (std::ranges::min(weight) > at_side) return inside;
    return static_cast<std::uint8_t>(std::ranges::max_element(weight) - weight.begin());
}

/// The point of a mesh closest to p among the faces one comes by from `last`: on to the best of those around
/// the corner nearest to the closest point, while the distance falls.
/// \param corner  corner_by() of the point on `last` where one starts
inline Bvh::Hit walk(const FacesAround& around, const Patchwork& mesh, const Vector3& p, Index last,
              std::uint8_t corner) {
    const auto closest_on = [&](Index face) {
        const Triangle& t = mesh.triangles[face];
        return closest_point_on_triangle(p, mesh.positions[t[0]], mesh.positions[t[1]], mesh.positions[t[2]]);
    };
    ClosestPoint best = closest_on(last);
    if (corner == inside) corner = corner_by(engine::to_array(best.barycentric));
    while (corner != inside) {
        const Index from = last;
        for (const Index next : around[mesh.triangles[from][corner]]) {
            if (next == from) continue;
            const ClosestPoint hit = closest_on(next);
            if (hit.distance_squared < nearer_by * best.distance_squared) best = hit, last = next;
        }
        const std::uint8_t next_corner = corner_by(engine::to_array(best.barycentric));
        if (last == from && next_corner == corner) break;
        corner = next_corner;
    }
    return {last, engine::to_array(best.barycentric), engine::to_array(best.point), best.distance_squared};
}

/// What search_farthest() does, with search(i) for gap i.
/// \param squared   lengths of the gaps
/// \param is_found  of gap i: it is by a search
template <class IsFound, class Search>
void search_farthest_of(std::span<const double> squared, double share, Workers workers, IsFound&& is_found,
                        Search&& search) {
    while (true) {
        double longest = 0;
        for (const double length : squared) longest = std::max(longest, length);
        workers.poll(squared.size() / 16);
        std::vector<std::size_t> far;
        for (std::size_t i = 0; i < squared.size(); ++i) {
            if (squared[i] > share * share * longest && !is_found(i)) far.push_back(i);
        }
        workers.poll(squared.size() / 16);
        if (far.empty()) return;
        parallel_blocks(far.size(), 64, workers, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) search(far[i]);
        });
    }
}

/// Of each triangle: has it a corner that is not where it was? All of them where nothing was before.
inline std::vector<std::uint8_t> moved_triangles(std::span<const Triangle> triangles, std::span<const Vector3> from,
                                          std::span<const Vector3> to, Poll poll) {
    std::vector<std::uint8_t> moved(triangles.size(), 0);
    for (std::size_t f = 0; f < triangles.size(); ++f) {
        poll();
        if (triangles[f][0] == no_index) continue;
        for (const Index v : triangles[f]) moved[f] |= from.empty() || from[v] != to[v];
    }
    return moved;
}

FAQEM_INLINE void GapsThere::move_to(std::span<const Vector3> positions, Workers workers) {
    const std::vector<std::uint8_t> moved = moved_triangles(triangles_, positions_, positions, workers.poll);
    positions_.assign(positions.begin(), positions.end());
    parallel_blocks(spots_.size(), block, workers, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            if (!moved[spots_[i].face] && gaps_[i].face != no_index) continue;
            const Index last = gaps_[i].face;
            if (last == no_index) {
                search(i, i == begin ? no_index : gaps_[i - 1].face);
            } else {
                const Vector3 p = spots_[i].on(positions_, triangles_);
                set(i, p, walk(original_.around, original_.mesh, p, last, gaps_[i].corner));
            }
        }
    });
}

FAQEM_INLINE void GapsThere::search_farthest(double share, Workers workers) {
    search_farthest_of(
        squared_, share, workers, [&](std::size_t i) { return gaps_[i].is_found; },
        [&](std::size_t i) { search(i, gaps_[i].face); });
}

FAQEM_INLINE void GapsThere::search(std::size_t i, Index near) {
    const Vector3 p = spots_[i].on(positions_, triangles_);
    set(i, p, nearest(original_.tree, original_.mesh, p, near));
    gaps_[i].is_found = true;
}

FAQEM_INLINE void GapsThere::replace(std::span<const std::uint8_t> faces, std::span<const Spot> spots) {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < spots_.size(); ++i) {
        if (faces[spots_[i].face]) continue;
        spots_[kept] = spots_[i];
        squared_[kept] = squared_[i];
        gaps_[kept++] = gaps_[i];
    }
    spots_.resize(kept);
    gaps_.resize(kept);
    squared_.resize(kept);
    spots_.insert(spots_.end(), spots.begin(), spots.end());
    gaps_.resize(spots_.size());
    squared_.resize(spots_.size());
}

FAQEM_INLINE void GapsThere::set(std::size_t i, const Vector3& p, const Bvh::Hit& hit) {
    gaps_[i] = {engine::to_eigen(hit.point) - p, hit.face, corner_by(hit.barycentric)};
    squared_[i] = gaps_[i].gap.squaredNorm();
}

FAQEM_INLINE Vector3 GapsThere::normal(std::size_t i) const {
    return area_vector(positions_, triangles_[spots_[i].face]).normalized();
}

FAQEM_INLINE Pull GapsThere::pull(std::size_t i) const { return {spots_[i], gaps_[i].gap, normal(i)}; }

FAQEM_INLINE void GapsThere::measure_turns(double tolerance, Workers workers) {
    parallel_blocks(spots_.size(), block, workers, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            Gap& gap = gaps_[i];
            if (!(gap.turn < 0)) continue;
            const Vector3 n = normal(i);
            double cosine = n.dot(original_.normals[gap.face]);
            if (!(gap.corner == inside && cosine > surely_alone)) {
                Bvh::Hit hit;
                hit.face = gap.face;
                hit.distance_squared = squared_[i];
                const Vector3 p = spots_[i].on(positions_, triangles_);
                cosine =
                    best_cosine(original_.tree, original_.normals, engine::to_array(p), hit, n, tolerance);
            }
            gap.turn = std::sqrt(std::max(0.0, 2 - 2 * cosine));
        }
    });
}

FAQEM_INLINE void GapsBack::move_to(std::span<const Vector3> positions, Workers workers,
                       std::span<const std::uint8_t> swapped) {
    if (positions_.empty()) return start_at(positions, workers);
    std::vector<std::uint8_t> moved = moved_triangles(triangles_, positions_, positions, workers.poll);
    for (std::size_t f = 0; f < swapped.size(); ++f) moved[f] |= swapped[f];
    if (!swapped.empty()) around_ = faces_around(positions.size(), triangles_, workers.poll);
    positions_.assign(positions.begin(), positions.end());
    tree_is_behind_ = true;
    std::vector<std::uint8_t> to_measure = moved;
    for (std::size_t f = 0; f < moved.size(); ++f) {
        workers.poll();
        if (!moved[f]) continue;
        for (const Index v : triangles_[f]) {
            for (const Index neighbour : around_[v]) to_measure[neighbour] = 1;
        }
    }
    parallel_blocks(points_.size(), block, workers, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const Spot& last = gaps_[i].spot;
            gaps_[i].is_found = false;  // faces that were far away may have come near
            if (!to_measure[last.face]) continue;
            set(i, walk(around_, {positions_, triangles_}, points_[i].position, last.face,
                        corner_by(last.weight)));
        }
    });
}

FAQEM_INLINE void GapsBack::start_at(std::span<const Vector3> positions, Workers workers) {
    around_ = faces_around(positions.size(), triangles_, workers.poll);
    positions_.assign(positions.begin(), positions.end());
    tree_.emplace(positions_, triangles_, workers.poll);
    parallel_blocks(points_.size(), block, workers, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) search(i, i == begin ? no_index : gaps_[i - 1].spot.face);
    });
}

FAQEM_INLINE void GapsBack::search_farthest(double share, Workers workers) {
    if (std::exchange(tree_is_behind_, false)) tree_->refit(positions_, triangles_, workers.poll);
    search_farthest_of(
        squared_, share, workers, [&](std::size_t i) { return gaps_[i].is_found; },
        [&](std::size_t i) { search(i, gaps_[i].spot.face); });
}

FAQEM_INLINE void GapsBack::search(std::size_t i, Index near) {
    set(i, nearest(*tree_, {positions_, triangles_}, points_[i].position, near));
    gaps_[i].is_found = true;
}

FAQEM_INLINE void GapsBack::set(std::size_t i, const Bvh::Hit& hit) {
    gaps_[i] = {{hit.face, hit.barycentric}, points_[i].position - engine::to_eigen(hit.point), false};
    squared_[i] = gaps_[i].gap.squaredNorm();
}

}  // namespace detail
FAQEM_NAMESPACE_END
