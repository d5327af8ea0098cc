#pragma once
/// \file
/// The boundary loops of a mesh during simplification, and the distances between them.

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "faqem/engine/mesh/boundary_edges.hpp"
#include "faqem/engine/mesh/collapse_mesh.hpp"
#include "faqem/engine/mesh/pair_table.hpp"
#include "faqem/engine/mesh/union_find.hpp"
#include "faqem/export.hpp"

FAQEM_ENGINE_BEGIN

/// Measures the error of collapses that close or open a boundary loop. Closing a small hole hardly moves
/// the surface, but its boundary vanishes; the points on it are then as far from the boundary as the
/// nearest other loop. A loop is a connected set of boundary edges and exists as long as it has an edge.
/// Not thread-safe.
class BoundaryLoops {
public:
    /// Finds the boundary loops. O(vertices + n log n) for n boundary vertices
    BoundaryLoops(const CollapseMesh& mesh, const PairTable& pairs) {
        for (Index v = 0; v < mesh.vertex_slots(); ++v) {
            if (mesh.degree(v) > 0) box_.extend(mesh.position(v));
            if (pairs.boundary_degree(v) > 0) points_.push_back({mesh.position(v), v});
        }
        find_boundaries(mesh.vertex_slots(), pairs);
        build_kd_tree(0, points_.size(), 0);
    }

    /// Error of the collapse of (u, v) at the boundary loops, as a squared distance:
    /// * if a loop vanishes, the distance from the pair to the nearest other loop that still exists, in its
    ///     initial position, plus the largest distance of loops that vanished next to this one before
    /// * if a loop appears, the distance from the pair to the nearest initial loop
    /// * otherwise 0
    ///
    /// If there is no other loop, the distance is the diagonal of the bounding box. O(1), unless a loop can
    /// vanish or appear: then O(valence squared), plus typically O(log n) for n boundary vertices.
    /// \param u, v  vertices of the pair, before the collapse
    /// \param pair  their index in `pairs`
    /// \return engine units squared
    double squared_distance(const CollapseMesh& mesh, const PairTable& pairs, Index u, Index v, Index pair) {
        const std::uint32_t at_u = pairs.boundary_degree(u), at_v = pairs.boundary_degree(v);
        if (at_u + at_v == 0)
            return starts_boundary(mesh, pairs, u, v) ? squared_distance_to_initial(mesh.position(u)) : 0;
        const std::uint32_t both = at_u + at_v - (pairs.face_count(pair) == 1);
        const bool are_same = at_u > 0 && at_v > 0 && boundary_of(u) == boundary_of(v);
        const bool u_may_end = at_u > 0 && boundaries_[boundary_of(u)].edges <= (are_same ? both : at_u);
        const bool v_may_end = at_v > 0 && !are_same && boundaries_[boundary_of(v)].edges <= at_v;
        if (!u_may_end && !v_may_end) return 0;
        bool u_lives = false, v_lives = false;
        for_each_boundary_edge_after(mesh, pairs, u, v, [&](const BoundaryEdge& edge) {
            u_lives |= edge.with_u == 1 || (are_same && edge.with_v == 1);
            v_lives |= edge.with_v == 1;
        });
        double farthest = 0;
        if (u_may_end && !u_lives) farthest = squared_distance_to_next(mesh.position(u), boundary_of(u));
        if (v_may_end && !v_lives)
            farthest = std::max(farthest, squared_distance_to_next(mesh.position(v), boundary_of(v)));
        return farthest;
    }

    /// Must be called before v is merged into u. `pair` is their index in `pairs`.
    void before_collapse(const PairTable& pairs, Index u, Index v, Index pair) {
        const std::uint32_t at_u = pairs.boundary_degree(u), at_v = pairs.boundary_degree(v);
        edges_before_ = at_u + at_v;
        if (edges_before_ == 0) return;
        edges_before_ -= pairs.face_count(pair) == 1;
        if (at_u == 0) boundary_of_vertex_[u] = boundary_of_vertex_[v];
        if (at_u > 0 && at_v > 0) merge_boundaries(boundary_of(u), boundary_of(v));
    }

    /// Must be called after v was merged into u. O(valence)
    void after_collapse(const CollapseMesh& mesh, const PairTable& pairs, Index u) {
        if (edges_before_ + pairs.boundary_degree(u) == 0) return;
        if (edges_before_ == 0) boundary_of_vertex_[u] = add_boundary();
        pairs.for_each_pair(u, [&](Neighbour n) {
            if (pairs.face_count(n.pair) != 1) return;
            if (boundary_of_vertex_[n.vertex] == no_index)
                boundary_of_vertex_[n.vertex] = boundary_of_vertex_[u];
            merge_boundaries(boundary_of(u), boundary_of(n.vertex));
        });
        Boundary& own = boundaries_[boundary_of(u)];
        own.edges += pairs.boundary_degree(u);
        own.edges -= std::min(edges_before_, own.edges);
        if (own.edges > 0) return;
        const double reach = std::sqrt(squared_distance_to_next(mesh.position(u), boundary_of(u)));
        if (own.next == no_index) return;
        Boundary& next = boundaries_[boundary_of(own.next)];
        next.reach = std::max(next.reach, reach);
    }

private:
    struct Point {
        Vector3 position;
        Index vertex;
    };
    struct Boundary {
        std::uint32_t edges = 0;      ///< current number of edges
        Index next = no_index;        ///< vertex of the nearest other loop, if already searched
        double squared_distance = 0;  ///< distance to it
        double reach = 0;             ///< largest distance to this loop from loops that have vanished
    };

    void find_boundaries(std::size_t vertices, const PairTable& pairs) {
        boundary_of_vertex_.assign(vertices, no_index);
        if (points_.empty()) return;
        const auto is_open = [&](Index pair) { return pairs.face_count(pair) == 1; };
        UnionFind joined(vertices);
        for (Index pair = 0; pair < pairs.size(); ++pair)
            if (is_open(pair)) joined.unite(pairs.first(pair), pairs.second(pair));
        for (const auto& [position, v] : points_) {  // the smallest vertex of each set comes first
            if (joined.find(v) == v) boundary_of_vertex_[v] = add_boundary();
            boundary_of_vertex_[v] = boundary_of_vertex_[joined.find(v)];
        }
        for (Index pair = 0; pair < pairs.size(); ++pair)
            if (is_open(pair)) ++boundaries_[boundary_of_vertex_[pairs.first(pair)]].edges;
    }

    Index add_boundary() {
        boundaries_.emplace_back();
        return sets_.add();
    }

    // \pre v is or was on a boundary
    Index boundary_of(Index v) { return sets_.find(boundary_of_vertex_[v]); }

    void merge_boundaries(Index a, Index b) {
        if (a == b) return;
        sets_.unite(a, b);
        Boundary& survivor = boundaries_[sets_.find(a)];
        const Boundary& other = boundaries_[sets_.find(a) == a ? b : a];
        survivor.edges += other.edges;
        survivor.reach = std::max(survivor.reach, other.reach);
    }

    static bool starts_boundary(const CollapseMesh& mesh, const PairTable& pairs, Index u, Index v) {
        bool any = false;
        if (pairs.nonmanifold_degree(u) + pairs.nonmanifold_degree(v) > 0)
            for_each_boundary_edge_after(mesh, pairs, u, v, [&](const BoundaryEdge&) { any = true; });
        return any;
    }

    bool is_other_boundary(Index v, Index own) {
        return boundary_of(v) != own && boundaries_[boundary_of(v)].edges > 0;
    }

    double squared_distance_to_initial(const Vector3& p) {
        Boundary nearest;
        nearest.squared_distance = box_.isEmpty() ? 0 : box_.diagonal().squaredNorm();
        search(
            0, points_.size(), 0, p, [](Index) { return true; }, nearest);
        return nearest.squared_distance;
    }

    // Squared distance of loop `own` at p, and of vanished loops assigned to it, to the next loop.
    double squared_distance_to_next(const Vector3& p, Index own) {
        Boundary& boundary = boundaries_[own];
        if (boundary.next == no_index || !is_other_boundary(boundary.next, own)) {
            boundary.next = no_index;
            boundary.squared_distance = box_.diagonal().squaredNorm();
            search(
                0, points_.size(), 0, p, [&](Index v) { return is_other_boundary(v, own); }, boundary);
        }
        const double distance = std::sqrt(boundary.squared_distance) + boundary.reach;
        return distance * distance;
    }

    // Builds a k-d tree: the middle element of a range is the node that splits it.
    void build_kd_tree(std::size_t begin, std::size_t end, int axis) {
        if (end - begin < 2) return;
        const std::size_t middle = begin + (end - begin) / 2;
        const auto at = [&](std::size_t i) { return points_.begin() + static_cast<std::ptrdiff_t>(i); };
        std::nth_element(at(begin), at(middle), at(end), [axis](const Point& a, const Point& b) {
            return std::pair(a.position[axis], a.vertex) < std::pair(b.position[axis], b.vertex);
        });
        build_kd_tree(begin, middle, (axis + 1) % 3);
        build_kd_tree(middle + 1, end, (axis + 1) % 3);
    }

    template <class Filter>
    void search(std::size_t begin, std::size_t end, int axis, const Vector3& p, const Filter& filter,
                Boundary& nearest) {
        if (begin == end) return;
        const std::size_t middle = begin + (end - begin) / 2;
        const auto& [position, v] = points_[middle];
        const double distance = (position - p).squaredNorm();
        if (std::pair(distance, v) < std::pair(nearest.squared_distance, nearest.next) && filter(v)) {
            nearest.squared_distance = distance;
            nearest.next = v;
        }
        const double side = p[axis] - position[axis];
        std::array<std::pair<std::size_t, std::size_t>, 2> halves = {{{begin, middle}, {middle + 1, end}}};
        if (!(side < 0)) std::swap(halves[0], halves[1]);
        search(halves[0].first, halves[0].second, (axis + 1) % 3, p, filter, nearest);
        if (side * side <= nearest.squared_distance)
            search(halves[1].first, halves[1].second, (axis + 1) % 3, p, filter, nearest);
    }

    Eigen::AlignedBox3d box_;                // bounding box of the mesh
    std::vector<Point> points_;              // initial boundary vertices, as a k-d tree
    std::vector<Index> boundary_of_vertex_;  // per vertex; no_index if it was never on a boundary
    std::vector<Boundary> boundaries_;       // indexed by the smallest member of a set in sets_
    UnionFind sets_;                         // loops that were merged
    std::uint32_t edges_before_ = 0;         // boundary edges at the pair that is collapsed
};

FAQEM_ENGINE_END
