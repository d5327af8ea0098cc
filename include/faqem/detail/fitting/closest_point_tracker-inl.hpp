#pragma once

#include "faqem/detail/fitting/closest_point_tracker.hpp"

#include <algorithm>
#include <cmath>

#include "faqem/detail/geometry/surface.hpp"

FAQEM_DETAIL_BEGIN

/// Number of points per block. The closest point of the first one is searched without an initial bound.
inline constexpr std::size_t tracker_block_size = 1024;
/// If a closest point is in the interior of a face and the cosine between the normals exceeds this, no other
/// face needs to be considered: an equally close face would be coincident with it and have the same normal.
inline constexpr double unambiguous_cosine = 0.5;

/// Where a vertex has more faces than this, a global search is faster than visiting all of them.
inline constexpr std::size_t max_walked_valence = 32;

/// Barycentric coordinate below which a point counts as lying on the edge opposite to the corner.
inline constexpr double edge_tolerance = 1e-9;
/// Result of nearest_corner() for a point that is on no edge.
inline constexpr std::uint8_t interior = 3;
/// Factor by which a squared distance must decrease; smaller differences may be due to rounding.
inline constexpr double improvement_ratio = 1 - 1e-12;

/// The point of a mesh that is closest to p.
/// \param tree  the tree of the mesh
/// \param near  a face that is probably near p, or no_index
inline Bvh::Hit nearest(const Bvh& tree, const MeshRef& mesh, const Vector3& p, Index near) {
    if (near == no_index) return tree.closest(to_array(p));
    const Triangle& t = mesh.triangles[near];
    return tree.closest_with_hint(to_array(p), near, mesh.positions[t[0]], mesh.positions[t[1]],
                                  mesh.positions[t[2]]);
}

/// The corner of a face that is nearest to a point on its boundary, or `interior` if the point is on no edge.
/// \param weights  its barycentric coordinates
inline std::uint8_t nearest_corner(const Vec3& weights) {
    if (std::min({weights[0], weights[1], weights[2]}) > edge_tolerance) return interior;
    return static_cast<std::uint8_t>(std::max_element(weights.begin(), weights.end()) - weights.begin());
}

/// Local closest-point search. Starting at face `last`, repeatedly moves to the closest face of the one-ring
/// of the corner that is nearest to the current closest point, while the distance decreases.
/// \param corner  nearest_corner() of the previous closest point on `last`
/// \param tree    if not null, that of the mesh, which is searched at vertices of high valence
inline Bvh::Hit walk_to_closest(const VertexFaces& vertex_faces, const MeshRef& mesh, const Vector3& p,
                                Index last, std::uint8_t corner, const Bvh* tree = nullptr) {
    const auto closest_on = [&](Index face) {
        const Triangle& t = mesh.triangles[face];
        return closest_point_on_triangle(p, mesh.positions[t[0]], mesh.positions[t[1]], mesh.positions[t[2]]);
    };
    ClosestPoint best = closest_on(last);
    if (corner == interior) corner = nearest_corner(to_array(best.barycentric));
    while (corner != interior) {
        const Index from = last;
        const auto around = vertex_faces[mesh.triangles[from][corner]];
        if (tree && around.size() > max_walked_valence) return nearest(*tree, mesh, p, last);
        for (const Index next : around) {
            if (next == from) continue;
            const ClosestPoint hit = closest_on(next);
            if (hit.distance_squared < improvement_ratio * best.distance_squared) best = hit, last = next;
        }
        const std::uint8_t next_corner = nearest_corner(to_array(best.barycentric));
        if (last == from && next_corner == corner) break;
        corner = next_corner;
    }
    return {last, to_array(best.barycentric), to_array(best.point), best.distance_squared};
}

/// Implements search_farthest() of both trackers.
/// \param squared   squared lengths of the residuals; updated by `search`
/// \param residuals  is_exact: the result of a global search
/// \param search    void(i): finds residual i by a global search; called concurrently
template <class Residual, class Search>
void search_above_share(std::span<const double> squared, const std::vector<Residual>& residuals, double share,
                        const RunContext& context, Search&& search) {
    while (true) {
        double longest = 0;
        for (const double length : squared) longest = std::max(longest, length);
        std::vector<std::size_t> far;
        for (std::size_t i = 0; i < squared.size(); ++i)
            if (squared[i] > share * share * longest && !residuals[i].is_exact) far.push_back(i);
        if (far.empty()) return;
        parallel_each(far.size(), 64, context, [&](std::size_t i) { search(far[i]); });
    }
}

/// For each triangle, whether one of its corners has moved; all of them if `from` is empty.
inline std::vector<std::uint8_t> moved_triangles(std::span<const Triangle> triangles,
                                                 std::span<const Vector3> from, std::span<const Vector3> to) {
    std::vector<std::uint8_t> moved(triangles.size(), 0);
    for (std::size_t f = 0; f < triangles.size(); ++f) {
        if (triangles[f][0] == no_index) continue;
        for (const Index v : triangles[f]) moved[f] |= from.empty() || from[v] != to[v];
    }
    return moved;
}

FAQEM_INLINE void MeshToReferenceTracker::update(std::span<const Vector3> positions,
                                                 const RunContext& context) {
    const std::vector<std::uint8_t> moved = moved_triangles(triangles_, positions_, positions);
    positions_.assign(positions.begin(), positions.end());
    parallel_blocks(samples_.size(), tracker_block_size, context, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            if (!moved[samples_[i].face] && residuals_[i].face != no_index) continue;
            const Index last = residuals_[i].face;
            if (last == no_index) {
                search(i, i == begin ? no_index : residuals_[i - 1].face);
            } else {
                const Vector3 p = samples_[i].position(positions_, triangles_);
                set_residual(i, p,
                             walk_to_closest(original_.vertex_faces, original_.mesh, p, last,
                                             residuals_[i].corner, &original_.tree));
            }
        }
    });
}

FAQEM_INLINE void MeshToReferenceTracker::search_farthest(double share, const RunContext& context) {
    search_above_share(squared_distances_, residuals_, share, context,
                       [&](std::size_t i) { search(i, residuals_[i].face); });
}

FAQEM_INLINE void MeshToReferenceTracker::search(std::size_t i, Index near) {
    const Vector3 p = samples_[i].position(positions_, triangles_);
    set_residual(i, p, nearest(original_.tree, original_.mesh, p, near));
    residuals_[i].is_exact = true;
}

FAQEM_INLINE void MeshToReferenceTracker::replace_samples(std::span<const std::uint8_t> faces,
                                                          std::span<const SurfaceSample> samples) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < samples_.size(); ++i) {
        if (faces[samples_[i].face]) continue;
        samples_[count] = samples_[i];
        squared_distances_[count] = squared_distances_[i];
        residuals_[count++] = residuals_[i];
    }
    samples_.resize(count);
    residuals_.resize(count);
    squared_distances_.resize(count);
    samples_.insert(samples_.end(), samples.begin(), samples.end());
    residuals_.resize(samples_.size());
    squared_distances_.resize(samples_.size());
}

FAQEM_INLINE void MeshToReferenceTracker::set_residual(std::size_t i, const Vector3& p, const Bvh::Hit& hit) {
    residuals_[i] = {to_eigen(hit.point) - p, hit.face, nearest_corner(hit.barycentric)};
    squared_distances_[i] = residuals_[i].residual.squaredNorm();
}

FAQEM_INLINE Vector3 MeshToReferenceTracker::normal(std::size_t i) const {
    return area_vector(positions_, triangles_[samples_[i].face]).normalized();
}

FAQEM_INLINE Correspondence MeshToReferenceTracker::correspondence(std::size_t i) const {
    return {samples_[i], residuals_[i].residual, normal(i)};
}

FAQEM_INLINE void MeshToReferenceTracker::measure_normal_deviations(double tolerance,
                                                                    const RunContext& context) {
    parallel_each(samples_.size(), tracker_block_size, context, [&](std::size_t i) {
        Residual& residual = residuals_[i];
        if (!(residual.normal_deviation < 0)) return;
        const Vector3 n = normal(i);
        double cosine = n.dot(original_.normals[residual.face]);
        if (!(residual.corner == interior && cosine > unambiguous_cosine)) {
            Bvh::Hit hit;
            hit.face = residual.face;
            hit.distance_squared = squared_distances_[i];
            const Vector3 p = samples_[i].position(positions_, triangles_);
            cosine = max_normal_cosine(original_.tree, original_.normals, to_array(p), hit, n, tolerance);
        }
        residual.normal_deviation = std::sqrt(std::max(0.0, 2 - 2 * cosine));
    });
}

FAQEM_INLINE void ReferenceToMeshTracker::update(std::span<const Vector3> positions,
                                                 const RunContext& context,
                                                 std::span<const std::uint8_t> flipped) {
    if (positions_.empty()) return initialize(positions, context);
    std::vector<std::uint8_t> moved = moved_triangles(triangles_, positions_, positions);
    for (std::size_t f = 0; f < flipped.size(); ++f) moved[f] |= flipped[f];
    if (!flipped.empty()) vertex_faces_ = make_vertex_faces(positions.size(), triangles_);
    positions_.assign(positions.begin(), positions.end());
    is_tree_outdated_ = true;
    std::vector<std::uint8_t> to_measure = moved;
    for (std::size_t f = 0; f < moved.size(); ++f) {
        if (!moved[f]) continue;
        for (const Index v : triangles_[f])
            for (const Index neighbour : vertex_faces_[v]) to_measure[neighbour] = 1;
    }
    parallel_each(points_.size(), tracker_block_size, context, [&](std::size_t i) {
        const SurfaceSample& last = residuals_[i].sample;
        residuals_[i].is_exact = false;  // a distant face may have come closer
        if (!to_measure[last.face]) return;
        set_residual(i, walk_to_closest(vertex_faces_, {positions_, triangles_}, points_[i].position,
                                        last.face, nearest_corner(last.barycentric)));
    });
}

FAQEM_INLINE void ReferenceToMeshTracker::initialize(std::span<const Vector3> positions,
                                                     const RunContext& context) {
    vertex_faces_ = make_vertex_faces(positions.size(), triangles_);
    positions_.assign(positions.begin(), positions.end());
    tree_.emplace(positions_, triangles_, context);
    parallel_blocks(points_.size(), tracker_block_size, context, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i)
            search(i, i == begin ? no_index : residuals_[i - 1].sample.face);
    });
}

FAQEM_INLINE void ReferenceToMeshTracker::search_farthest(double share, const RunContext& context) {
    if (std::exchange(is_tree_outdated_, false)) tree_->refit(positions_, triangles_);
    search_above_share(squared_distances_, residuals_, share, context,
                       [&](std::size_t i) { search(i, residuals_[i].sample.face); });
}

FAQEM_INLINE void ReferenceToMeshTracker::search(std::size_t i, Index near) {
    set_residual(i, nearest(*tree_, {positions_, triangles_}, points_[i].position, near));
    residuals_[i].is_exact = true;
}

FAQEM_INLINE void ReferenceToMeshTracker::set_residual(std::size_t i, const Bvh::Hit& hit) {
    residuals_[i] = {{hit.face, hit.barycentric}, points_[i].position - to_eigen(hit.point), false};
    squared_distances_[i] = residuals_[i].residual.squaredNorm();
}

FAQEM_DETAIL_END
