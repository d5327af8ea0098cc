#pragma once
/// \file
/// Which part of the original's border each open edge of today stands for.

#include <algorithm>
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

FAQEM_NAMESPACE_BEGIN
namespace engine {

/// The vertices of the original's border, each bound to an open edge of today near it; those of a border that
/// has come to its end are bound to none. Nothing is kept for a surface without border.
class BoundaryBindings {
public:
    /// Binds every point to an open edge near it.
    /// \param tracked  of the vertices to look after; original vertices in ascending order
    /// \throws what the poll throws
    /// O(open edges + lineage), typically
    BoundaryBindings(const OriginalSurface& original, const TrackedVertices& tracked,
                     const CollapseMesh& mesh, const PairTable& pairs,
                     CancellationCheck check_cancelled = {}) {
        const std::vector<Index> current = collect_points(original, tracked, check_cancelled);
        if (points_.empty()) return;
        first_bound_.assign(pairs.size(), no_index);
        next_bound_.assign(points_.size(), no_index);
        for (Index i = 0; i < points_.size(); ++i) {
            check_cancelled();
            const Index pair = find_near_edge(mesh, pairs, points_[i].position, current[i]);
            if (pair != no_index) bind(i, pair);
        }
    }

    /// How far the collapse of (u, v) to p would take the border from the original's: the largest squared
    /// distance of what is bound around the pair from the open edges there would be, and of p and the middles
    /// of these edges from the original border there: an edge from one border to another is far from both.
    /// Where nothing is bound to the edges at hand, what is to the next ones says where the border was. 0
    /// where there is no border, or it comes to its end. O(bound points times valence)
    double squared_distance(const CollapseMesh& mesh, const PairTable& pairs, Index u, Index v,
                            const Vector3& p) {
        if (!touches_boundary(pairs, u, v)) return 0;
        gather(pairs, u, v);
        edges_.clear();
        ends_.clear();
        for_each_boundary_edge_after(mesh, pairs, u, v, [&](const BoundaryEdge& edge) {
            const Vector3& end = mesh.position(edge.vertex);
            edges_.emplace_back(p, end);
            ends_.push_back(edge.vertex);
        });
        if (edges_.empty()) return 0;
        FarthestPoint farthest(edges_);
        for (const Index i : bound_) farthest.add(points_[i].position);
        if (bound_.empty()) {
            for (const Index n : ends_) gather_at(pairs, n, no_index);
        }
        if (bound_.empty()) return 0;
        double worst = std::max(farthest.squared_distance(), squared_distance_to_original(p));
        for (const Index n : ends_)
            worst = std::max(worst, squared_distance_to_original(0.5 * (p + mesh.position(n))));
        return worst;
    }

    /// u and v are about to become one.
    void before_collapse(const PairTable& pairs, Index u, Index v) {
        bound_.clear();
        if (!touches_boundary(pairs, u, v)) return;
        gather(pairs, u, v);
        for (const Index a : {u, v}) {
            pairs.for_each_pair(a, [&](Neighbour n) {
                if (pairs.face_count(n.pair) == 1) first_bound_[n.pair] = no_index;
            });
        }
    }

    /// They have.
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
        std::size_t first_segment;  ///< of the far ends of its original open edges
    };

    // Makes the points and their segments. \return the vertex of the complex that each point has gone into
    std::vector<Index> collect_points(const OriginalSurface& original, const TrackedVertices& tracked,
                                      CancellationCheck check_cancelled) {
        std::vector<Index> current;
        for (std::size_t i = 0; i < tracked.original.size(); ++i) {
            check_cancelled();
            const Index v = tracked.original[i];
            const std::span<const Index> ends = original.boundary_neighbours(v);
            if (ends.empty()) continue;
            points_.push_back({original.position(v), v, segments_.size()});
            current.push_back(tracked.current[i]);
            for (const Index other : ends) segments_.push_back(original.position(other));
        }
        return current;
    }

    // Where the original has no border, one that begins has nothing to be compared with.
    bool touches_boundary(const PairTable& pairs, Index u, Index v) const {
        return !points_.empty() && pairs.boundary_degree(u) + pairs.boundary_degree(v) > 0;
    }

    void bind(Index point, Index pair) {
        next_bound_[point] = first_bound_[pair];
        first_bound_[pair] = point;
    }

    // What is bound to the open edges of u and v.
    void gather(const PairTable& pairs, Index u, Index v) {
        bound_.clear();
        gather_at(pairs, u, no_index);
        gather_at(pairs, v, u);
    }

    // Adds what is bound to the open edges of v but the one to `excluded`.
    void gather_at(const PairTable& pairs, Index v, Index excluded) {
        pairs.for_each_pair(v, [&](Neighbour n) {
            if (pairs.face_count(n.pair) != 1 || n.vertex == excluded) return;
            for (Index i = first_bound_[n.pair]; i != no_index; i = next_bound_[i]) bound_.push_back(i);
        });
    }

    // From p to the original border around the nearest point that was gathered. \pre there is one
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
        for (std::size_t k = points_[point].first_segment; k < end; ++k) {
            nearest = std::min(nearest, SegmentDistance(x, segments_[k])(p));
        }
        return nearest;
    }

    // Goes from the open edges at `today` to nearer and nearer ones; no_index where it has none.
    static Index find_near_edge(const CollapseMesh& mesh, const PairTable& pairs, const Vector3& x,
                                Index current) {
        Index best = no_index;
        double nearest = std::numeric_limits<double>::infinity();
        const auto look_around = [&](Index v) {
            const Index before = best;
            pairs.for_each_pair(v, [&](Neighbour n) {
                if (pairs.face_count(n.pair) != 1) return;
                const double d = SegmentDistance(mesh.position(v), mesh.position(n.vertex))(x);
                if (d < nearest) nearest = d, best = n.pair;
            });
            return best != before;
        };
        for (bool nearer = look_around(current); nearer && nearest > 0;) {
            const Index first = pairs.first(best), second = pairs.second(best);
            nearer = look_around(first);
            nearer |= look_around(second);
        }
        return best;
    }

    std::vector<Point> points_;
    std::vector<Vector3> segments_;
    std::vector<Index> first_bound_, next_bound_;  // lists of points bound to each pair
    std::vector<Index> bound_;                     // points around the pair in hand
    std::vector<SegmentDistance> edges_;           // open edges there would be, or are
    std::vector<Index> edge_pairs_, ends_;         // their pairs, their far ends
};

}  // namespace engine
FAQEM_NAMESPACE_END
