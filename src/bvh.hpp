#pragma once
/// \file
/// Exact closest points on a triangle mesh by a tree of boxes. Own code, because CGAL's AABB tree is GPL,
/// Embree computes in single precision, and no other library with exact double distances is packaged.

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "faqem/mesh.hpp"
#include "triangle.hpp"

namespace faqem::detail {

/// Binary tree of axis-aligned boxes over triangles, in double. Queries may come from several threads at
/// once. Depends on nothing but the mesh: same input, same tree.
class Bvh {
public:
    /// \param positions  finite
    /// \param triangles  corners < positions.size(); faces with a corner no_index are left out. Faces without
    ///                   area count as the segment or point that they are.
    /// Keeps copies. O(n log n) time, about 140 bytes per face.
    Bvh(std::span<const Vec3> positions, std::span<const Triangle> triangles);
    Bvh(std::span<const engine::Vector3> positions, std::span<const Triangle> triangles);

    /// Takes over new positions; the tree's shape stays, and is good as long as little has moved.
    /// \param triangles  those of the constructor
    /// O(n)
    void refit(std::span<const engine::Vector3> positions, std::span<const Triangle> triangles);

    /// A point of the mesh.
    struct Hit {
        Index face = no_index;  ///< index into the constructor's triangles; no_index: nothing in range
        Vec3 barycentric = {};  ///< weights of the face's corners, >= 0, sum 1
        Vec3 point = {};
        double distance_squared = std::numeric_limits<double>::infinity();
    };

    bool empty() const { return triangles_.empty(); }

    /// The point of the mesh closest to p, if it is at most sqrt(max_distance_squared) away (inclusive). Of
    /// faces at the same distance the one with the smallest index. O(log n) typically.
    Hit closest(const Vec3& p, double max_distance_squared = std::numeric_limits<double>::infinity()) const {
        return closest_if(
            p, [](Index) { return true; }, max_distance_squared);
    }

    /// As closest() without limit, for one who knows a face near p; the nearer, the faster.
    /// \param face     of the tree
    /// \param a,b,c    its corners
    Hit closest_from(const Vec3& p, Index face, const engine::Vector3& a, const engine::Vector3& b,
                     const engine::Vector3& c) const {
        const ClosestPoint near = closest_point_on_triangle(engine::to_eigen(p), a, b, c);
        const Hit hit = closest(p, near.distance_squared);
        if (hit.face != no_index) return hit;
        // Rounding: the box may seem a last digit farther than what is in it.
        return {face, engine::to_array(near.barycentric), engine::to_array(near.point),
                near.distance_squared};
    }

    /// As closest(), over the faces f with filter(f) only. The filter is asked for faces that would be the
    /// best so far.
    template <class Filter>
    Hit closest_if(const Vec3& p, Filter&& filter,
                   double max_distance_squared = std::numeric_limits<double>::infinity()) const;

    /// Calls visit(face, const ClosestPoint&) for every face at most sqrt(distance_squared) from p, in no
    /// particular but always the same order.
    template <class Visit>
    void visit_within(const Vec3& p, double distance_squared, Visit&& visit) const;

private:
    using Vector3 = engine::Vector3;
    struct Node {
        Vector3 low, high;
        std::uint32_t first = 0;  ///< leaf: first of `triangles_`; inner: right child (the left one is next)
        std::uint32_t count = 0;  ///< leaf: number of triangles; inner: 0
        double distance_squared(const Vector3& p) const {
            return (low - p).cwiseMax(p - high).cwiseMax(0.0).squaredNorm();
        }
    };
    struct Corners {
        Vector3 a, b, c;
        Index face = no_index;
    };
    template <class Positions>
    static std::vector<Corners> corners(const Positions& positions, std::span<const Triangle> triangles);
    struct Pending {
        std::uint32_t node;
        double distance_squared;
    };
    /// Splits halve the range from `sah_levels` on, so that no tree over 2^32 faces is deeper.
    static constexpr int sah_levels = 48, max_depth = sah_levels + 34;

    struct Build;

    explicit Bvh(std::vector<Corners> triangles);

    /// Visits leaves' triangles, nearest box first, while their box is within limit() of p.
    template <class Limit, class Leaf>
    void traverse(const Vector3& p, Limit&& limit, Leaf&& leaf) const;

    std::vector<Corners> triangles_;  ///< in leaf order
    std::vector<Node> nodes_;
};

template <class Limit, class Leaf>
void Bvh::traverse(const Vector3& p, Limit&& limit, Leaf&& leaf) const {
    if (nodes_.empty()) return;
    std::array<Pending, max_depth + 2> stack;
    std::size_t size = 0;
    stack[size++] = {0, nodes_[0].distance_squared(p)};
    while (size > 0) {
        const Pending top = stack[--size];
        if (!(top.distance_squared <= limit())) continue;
        const Node& node = nodes_[top.node];
        if (node.count > 0) {
            for (std::uint32_t i = node.first; i < node.first + node.count; ++i) leaf(triangles_[i]);
            continue;
        }
        Pending near{top.node + 1, nodes_[top.node + 1].distance_squared(p)};
        Pending far{node.first, nodes_[node.first].distance_squared(p)};
        if (far.distance_squared < near.distance_squared) std::swap(near, far);
        if (far.distance_squared <= limit()) stack[size++] = far;
        if (near.distance_squared <= limit()) stack[size++] = near;
    }
}

template <class Filter>
Bvh::Hit Bvh::closest_if(const Vec3& p, Filter&& filter, double max_distance_squared) const {
    const Vector3 query = engine::to_eigen(p);
    ClosestPoint best;
    best.distance_squared = max_distance_squared;
    Index face = no_index;
    traverse(
        query, [&] { return best.distance_squared; },
        [&](const Corners& t) {
            const ClosestPoint hit = closest_point_on_triangle(query, t.a, t.b, t.c);
            const bool nearer = hit.distance_squared < best.distance_squared;
            if (!nearer && !(hit.distance_squared == best.distance_squared && t.face < face)) return;
            if (!filter(t.face)) return;
            best = hit;
            face = t.face;
        });
    if (face == no_index) return {};
    return {face, engine::to_array(best.barycentric), engine::to_array(best.point), best.distance_squared};
}

template <class Visit>
void Bvh::visit_within(const Vec3& p, double distance_squared, Visit&& visit) const {
    const Vector3 query = engine::to_eigen(p);
    traverse(
        query, [&] { return distance_squared; },
        [&](const Corners& t) {
            const ClosestPoint hit = closest_point_on_triangle(query, t.a, t.b, t.c);
            if (hit.distance_squared <= distance_squared) visit(t.face, hit);
        });
}

}  // namespace faqem::detail
