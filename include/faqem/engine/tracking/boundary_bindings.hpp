#pragma once
/// \file
/// Bindings of the original boundary vertices to the boundary edges of the current mesh that represent
/// them.

#include <algorithm>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "faqem/engine/mesh/boundary_edges.hpp"
#include "faqem/engine/mesh/collapse_mesh.hpp"
#include "faqem/engine/mesh/pair_table.hpp"
#include "faqem/engine/tracking/distance.hpp"
#include "faqem/engine/tracking/original_surface.hpp"
#include "faqem/export.hpp"

FAQEM_ENGINE_BEGIN

/// The tracked vertices on the original boundary, each bound to one boundary edge near it. Vertices of a
/// boundary loop that has vanished are not bound. Needs no memory for a surface without boundary. Not
/// thread-safe.
class BoundaryBindings {
public:
    /// Where one vertex of a pair has more boundary edges than this, only those of the other vertex are tracked.
    static constexpr std::uint32_t max_tracked_edges = 64;

    /// Binds each tracked boundary vertex to a boundary edge near it. Typically O(boundary edges + tracked
    /// vertices)
    /// \param original         used during construction only
    /// \param tracked          the vertices to bind, original vertices ascending; the targets are vertices
    ///     of `mesh`
    /// \param mesh, pairs      the current mesh and its pairs
    BoundaryBindings(const OriginalSurface& original, const TrackedVertices& tracked,
                     const CollapseMesh& mesh, const PairTable& pairs) {
        const std::vector<Index> current = collect_points(original, tracked);
        if (points_.empty()) return;
        first_bound_.assign(pairs.size(), no_index);
        next_bound_.assign(points_.size(), no_index);
        for (Index i = 0; i < points_.size(); ++i) {
            const Index pair = find_near_edge(mesh, pairs, points_[i].position, current[i]);
            if (pair != no_index) bind(i, pair);
        }
    }

    /// Largest squared distance between the original boundary and the boundary after the collapse of (u, v)
    /// to p. Measured are the distances of the vertices bound around the pair from the new boundary edges,
    /// and the distances of p and of the midpoints of these edges from the original boundary near it; the
    /// midpoints, because an edge that connects two boundary loops is far from both. If no vertex is bound
    /// to the boundary edges at the pair, those bound to the adjacent boundary edges are used. O(bound
    /// vertices times valence)
    /// \param u, v  vertices of the pair, before the collapse
    /// \param p     position of the new vertex
    /// \return engine units squared; 0 if there is no boundary or the boundary loop vanishes
    double squared_distance(const CollapseMesh& mesh, const PairTable& pairs, Index u, Index v,
                            const Vector3& p) {
        if (!touches_boundary(pairs, u, v)) return 0;
        gather(pairs, u, v);
        edges_.clear();
        ends_.clear();
        const auto add = [&](const BoundaryEdge& edge) {
            edges_.emplace_back(p, mesh.position(edge.vertex));
            ends_.push_back(edge.vertex);
        };
        if (tracks_both(pairs, u, v))
            for_each_boundary_edge_after(mesh, pairs, u, v, add);
        else if (pairs.boundary_degree(u) <= pairs.boundary_degree(v))
            for_each_boundary_edge_after_at(mesh, pairs, u, v, add);
        else
            for_each_boundary_edge_after_at(mesh, pairs, v, u, add);
        if (edges_.empty()) return 0;
        FarthestPoint farthest(edges_);
        for (const Index i : bound_) farthest.add(points_[i].position);
        if (bound_.empty())
            for (const Index n : ends_) gather_at(pairs, n, no_index);
        if (bound_.empty()) return 0;
        double worst = std::max(farthest.squared_distance(), squared_distance_to_original(p));
        for (const Index n : ends_)
            worst = std::max(worst, squared_distance_to_original(0.5 * (p + mesh.position(n))));
        return worst;
    }

    /// Must be called before u and v are merged. O(valence + bound vertices)
    void before_collapse(const PairTable& pairs, Index u, Index v) {
        bound_.clear();
        if (!touches_boundary(pairs, u, v)) return;
        gather(pairs, u, v);
        for_each_tracked(pairs, u, v, [&](Index a) {
            pairs.for_each_pair(a, [&](Neighbour n) {
                if (pairs.face_count(n.pair) == 1) first_bound_[n.pair] = no_index;
            });
        });
    }

    /// Must be called after the collapse. O(valence times bound vertices)
    /// \param survivor  the remaining vertex
    /// \param around    its neighbours, from PairTable::merge()
    void after_collapse(const CollapseMesh& mesh, const PairTable& pairs, Index survivor,
                        std::span<const PairTable::Change> around) {
        if (bound_.empty()) return;
        edges_.clear();
        edge_pairs_.clear();
        for (const PairTable::Change& change : around) {
            const auto [n, pair] = change.neighbour;
            if (pair == no_index || pairs.face_count(pair) != 1) continue;
            edges_.emplace_back(mesh.position(survivor), mesh.position(n));
            edge_pairs_.push_back(pair);
        }
        if (edges_.empty()) return;
        for (const Index i : bound_) bind(i, edge_pairs_[nearest_index(edges_, points_[i].position)]);
    }

private:
    struct Point {
        Vector3 position;
        Index vertex;
        std::size_t first_segment;  ///< index in segments_ of its first boundary neighbour
    };

    // Sets points_ and segments_.
    // \return for each point, its vertex in the current mesh
    std::vector<Index> collect_points(const OriginalSurface& original, const TrackedVertices& tracked) {
        std::vector<Index> current;
        for (std::size_t i = 0; i < tracked.original.size(); ++i) {
            const Index v = tracked.original[i];
            const std::span<const Index> ends = original.boundary_neighbours(v);
            if (ends.empty()) continue;
            points_.push_back({original.position(v), v, segments_.size()});
            current.push_back(tracked.current[i]);
            for (const Index other : ends) segments_.push_back(original.position(other));
        }
        return current;
    }

    // If the original has no boundary, there is nothing to compare a new boundary with.
    bool touches_boundary(const PairTable& pairs, Index u, Index v) const {
        return !points_.empty() && pairs.boundary_degree(u) + pairs.boundary_degree(v) > 0;
    }

    void bind(Index point, Index pair) {
        next_bound_[point] = first_bound_[pair];
        first_bound_[pair] = point;
    }

    // Whether the edges of both vertices are tracked, or only those of the vertex with fewer.
    static bool tracks_both(const PairTable& pairs, Index u, Index v) {
        return std::max(pairs.boundary_degree(u), pairs.boundary_degree(v)) <= max_tracked_edges;
    }

    // Calls visit(vertex) for those of the pair whose edges are tracked.
    template <class Visit>
    static void for_each_tracked(const PairTable& pairs, Index u, Index v, Visit&& visit) {
        const bool both = tracks_both(pairs, u, v),
                   first = pairs.boundary_degree(u) <= pairs.boundary_degree(v);
        if (both || first) visit(u);
        if (both || !first) visit(v);
    }

    // Sets bound_ to the points bound to the boundary edges of the pair.
    void gather(const PairTable& pairs, Index u, Index v) {
        bound_.clear();
        Index excluded = no_index;
        for_each_tracked(pairs, u, v, [&](Index a) { gather_at(pairs, a, std::exchange(excluded, a)); });
    }

    // Adds the points bound to the boundary edges of v, except for the edge to `excluded`.
    void gather_at(const PairTable& pairs, Index v, Index excluded) {
        pairs.for_each_pair(v, [&](Neighbour n) {
            if (pairs.face_count(n.pair) != 1 || n.vertex == excluded) return;
            for (Index i = first_bound_[n.pair]; i != no_index; i = next_bound_[i]) bound_.push_back(i);
        });
    }

    // Squared distance from p to the original boundary edges at the nearest point in bound_.
    // \pre bound_ is not empty
    double squared_distance_to_original(const Vector3& p) const {
        Index nearest = no_index;
        double least = std::numeric_limits<double>::infinity();
        for (const Index i : bound_) {
            const double d = (points_[i].position - p).squaredNorm();
            if (d < least) least = d, nearest = i;
        }
        return squared_distance_to_ring(nearest, p);
    }

    double squared_distance_to_ring(Index point, const Vector3& p) const {
        const Vector3& x = points_[point].position;
        const std::size_t end =
            point + 1 < points_.size() ? points_[point + 1].first_segment : segments_.size();
        double nearest = (x - p).squaredNorm();
        for (std::size_t k = points_[point].first_segment; k < end; ++k)
            nearest = std::min(nearest, SegmentDistance(x, segments_[k])(p));
        return nearest;
    }

    // Finds a boundary edge near x by descent, starting with the boundary edges of `current`; no_index if
    // it has none.
    static Index find_near_edge(const CollapseMesh& mesh, const PairTable& pairs, const Vector3& x,
                                Index current) {
        Index best = no_index;
        double nearest = std::numeric_limits<double>::infinity();
        const auto search_edges_of = [&](Index v) {
            const Index before = best;
            pairs.for_each_pair(v, [&](Neighbour n) {
                if (pairs.face_count(n.pair) != 1) return;
                const double d = SegmentDistance(mesh.position(v), mesh.position(n.vertex))(x);
                if (d < nearest) nearest = d, best = n.pair;
            });
            return best != before;
        };
        for (bool nearer = search_edges_of(current); nearer && nearest > 0;) {
            const Index first = pairs.first(best), second = pairs.second(best);
            nearer = search_edges_of(first);
            nearer |= search_edges_of(second);
        }
        return best;
    }

    std::vector<Point> points_;
    std::vector<Vector3> segments_;                // original boundary neighbours of each point, by position
    std::vector<Index> first_bound_, next_bound_;  // linked list of the points bound to each pair
    std::vector<Index> bound_;                     // points bound around the current pair
    std::vector<SegmentDistance> edges_;           // boundary edges at the new vertex
    std::vector<Index> edge_pairs_, ends_;         // their pairs and their other ends
};

FAQEM_ENGINE_END
