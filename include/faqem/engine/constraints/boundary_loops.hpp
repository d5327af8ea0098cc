#pragma once
/// \file
/// The borders of a surface while it is simplified: where they end or begin, and how far the next one is.

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "faqem/export.hpp"
#include "faqem/engine/mesh/triangle_soup.hpp"
#include "faqem/engine/mesh/union_find.hpp"
#include "faqem/engine/mesh/boundary_edges.hpp"
#include "faqem/engine/mesh/pair_table.hpp"

FAQEM_NAMESPACE_BEGIN
namespace engine {

/// Where a small hole closes the surface hardly moves, but its border is gone: what stood there is as far
/// from a border as the next one is. Borders are connected sets of open edges; one lives as long as it has an
/// edge.
class BorderLoops {
public:
    /// \param first_context  vertices from here on, and the edges between them, are not looked at
    /// \throws what the poll throws
    /// O(vertices + n log n), where n vertices are on borders
    BorderLoops(const Complex& complex, const PairTable& pairs, Index first_context = no_index,
                Poll poll = {}) {
        for (Index v = 0; v < complex.vertex_slots(); ++v) {
            poll();
            if (complex.degree(v) > 0) box_.extend(complex.position(v));
            if (pairs.boundary_degree(v) > 0 && v < first_context)
                points_.push_back({complex.position(v), v});
        }
        find_borders(complex.vertex_slots(), pairs, first_context, poll);
        arrange(0, points_.size(), 0, poll);
    }

    /// What the collapse of (u, v) would do to borders, as a squared distance: where one ends, that to the
    /// nearest other one that lives, as it was at the start; where one begins, that to the nearest border of
    /// the start; that over the whole mesh where there is none; else 0.
    /// O(valence) at borders longer than their part at u and v; O(log n) typically where one ends
    double squared_distance(const Complex& complex, const PairTable& pairs, Index u, Index v, Index pair) {
        const std::uint32_t at_u = pairs.boundary_degree(u), at_v = pairs.boundary_degree(v);
        if (at_u + at_v == 0) return begins(complex, pairs, u, v) ? to_start(complex.position(u)) : 0;
        const std::uint32_t both = at_u + at_v - (pairs.face_count(pair) == 1);
        const bool are_one = at_u > 0 && at_v > 0 && border(u) == border(v);
        const bool u_may_end = at_u > 0 && borders_[border(u)].edges <= (are_one ? both : at_u);
        const bool v_may_end = at_v > 0 && !are_one && borders_[border(v)].edges <= at_v;
        if (!u_may_end && !v_may_end) return 0;
        bool u_lives = false, v_lives = false;
        for_each_open_edge_after(complex, pairs, u, v, [&](const OpenEdge& edge) {
            u_lives |= edge.with_u == 1 || (are_one && edge.with_v == 1);
            v_lives |= edge.with_v == 1;
        });
        double farthest = 0;
        if (u_may_end && !u_lives) farthest = to_next(complex.position(u), border(u));
        if (v_may_end && !v_lives) farthest = std::max(farthest, to_next(complex.position(v), border(v)));
        return farthest;
    }

    /// u and v are about to become u.
    void collapsing(const PairTable& pairs, Index u, Index v, Index pair) {
        const std::uint32_t at_u = pairs.boundary_degree(u), at_v = pairs.boundary_degree(v);
        edges_before_ = at_u + at_v;
        if (edges_before_ == 0) return;
        edges_before_ -= pairs.face_count(pair) == 1;
        if (at_u == 0) border_[u] = border_[v];
        if (at_u > 0 && at_v > 0) join(border(u), border(v));
    }

    /// They have. O(valence)
    void collapsed(const Complex& complex, const PairTable& pairs, Index u) {
        if (edges_before_ + pairs.boundary_degree(u) == 0) return;
        if (edges_before_ == 0) border_[u] = add_border();
        pairs.for_each_pair(u, [&](Neighbour n) {
            if (pairs.face_count(n.pair) != 1) return;
            if (border_[n.vertex] == no_index) border_[n.vertex] = border_[u];
            join(border(u), border(n.vertex));
        });
        Border& own = borders_[border(u)];
        own.edges += pairs.boundary_degree(u);
        own.edges -= std::min(edges_before_, own.edges);
        if (own.edges > 0) return;
        const double reach = std::sqrt(to_next(complex.position(u), border(u)));
        if (own.next == no_index) return;
        Border& next = borders_[border(own.next)];
        next.reach = std::max(next.reach, reach);
    }

private:
    struct Point {
        Vector3 position;
        Index vertex;
    };
    struct Border {
        std::uint32_t edges = 0;      ///< living ones
        Index next = no_index;        ///< vertex of the nearest other border, where that was asked for
        double squared_distance = 0;  ///< to it
        double reach = 0;             ///< distance of ended borders to which this one was the next
    };

    void find_borders(std::size_t vertices, const PairTable& pairs, Index first_context, Poll poll) {
        border_.assign(vertices, no_index);
        if (points_.empty()) return;
        const auto smaller_end = [&](Index pair) { return std::min(pairs.first(pair), pairs.second(pair)); };
        const auto is_open = [&](Index pair) {
            return pairs.face_count(pair) == 1 && smaller_end(pair) < first_context;
        };
        DisjointSets joined(vertices);
        for (Index pair = 0; pair < pairs.size(); ++pair) {
            poll();
            if (is_open(pair)) joined.join(pairs.first(pair), pairs.second(pair));
        }
        for (const auto& [position, v] : points_) {  // the smallest vertex of a set comes first
            if (joined.root(v) == v) border_[v] = add_border();
            border_[v] = border_[joined.root(v)];
        }
        for (Index pair = 0; pair < pairs.size(); ++pair) {
            if (is_open(pair)) ++borders_[border_[smaller_end(pair)]].edges;
        }
    }

    Index add_border() {
        borders_.emplace_back();
        return sets_.add();
    }

    // \pre v is or was on a border
    Index border(Index v) { return sets_.root(border_[v]); }

    void join(Index a, Index b) {
        if (a == b) return;
        sets_.join(a, b);
        Border& kept = borders_[sets_.root(a)];
        const Border& other = borders_[sets_.root(a) == a ? b : a];
        kept.edges += other.edges;
        kept.reach = std::max(kept.reach, other.reach);
    }

    static bool begins(const Complex& complex, const PairTable& pairs, Index u, Index v) {
        bool any = false;
        if (pairs.nonmanifold_degree(u) + pairs.nonmanifold_degree(v) > 0)
            for_each_open_edge_after(complex, pairs, u, v, [&](const OpenEdge&) { any = true; });
        return any;
    }

    bool is_other(Index v, Index own) { return border(v) != own && borders_[border(v)].edges > 0; }

    double to_start(const Vector3& p) {
        Border nearest;
        nearest.squared_distance = box_.isEmpty() ? 0 : box_.diagonal().squaredNorm();
        search(
            0, points_.size(), 0, p, [](Index) { return true; }, nearest);
        return nearest.squared_distance;
    }

    // From border `own` at p, and from those that have ended and went to it.
    double to_next(const Vector3& p, Index own) {
        Border& border = borders_[own];
        if (border.next == no_index || !is_other(border.next, own)) {
            border.next = no_index;
            border.squared_distance = box_.diagonal().squaredNorm();
            search(
                0, points_.size(), 0, p, [&](Index v) { return is_other(v, own); }, border);
        }
        const double distance = std::sqrt(border.squared_distance) + border.reach;
        return distance * distance;
    }

    // A k-d tree: the middle of a range splits it.
    void arrange(std::size_t begin, std::size_t end, int axis, Poll poll) {
        if (end - begin < 2) return;
        poll(end - begin);
        const std::size_t middle = begin + (end - begin) / 2;
        const auto at = [&](std::size_t i) { return points_.begin() + static_cast<std::ptrdiff_t>(i); };
        std::nth_element(at(begin), at(middle), at(end), [axis](const Point& a, const Point& b) {
            return std::pair(a.position[axis], a.vertex) < std::pair(b.position[axis], b.vertex);
        });
        arrange(begin, middle, (axis + 1) % 3, poll);
        arrange(middle + 1, end, (axis + 1) % 3, poll);
    }

    template <class Filter>
    void search(std::size_t begin, std::size_t end, int axis, const Vector3& p, const Filter& filter,
                Border& nearest) {
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

    Eigen::AlignedBox3d box_;         // of the surface
    std::vector<Point> points_;       // on its borders
    std::vector<Index> border_;       // of each vertex; no_index where it was never on one
    std::vector<Border> borders_;     // by the smallest member of each set
    DisjointSets sets_;               // of borders that have met
    std::uint32_t edges_before_ = 0;  // open ones of the pair that is being collapsed
};

}  // namespace engine
FAQEM_NAMESPACE_END
