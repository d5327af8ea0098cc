#pragma once
/// \file
/// Search for corners of a polygon that lie in a triangle.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "faqem/mesh.hpp"

namespace faqem::detail {

/// A point of the plane.
using PlanarPoint = std::array<double, 2>;

/// Twice the signed area of the triangle abc; positive if it is counter-clockwise.
inline double orient2d(const PlanarPoint& a, const PlanarPoint& b, const PlanarPoint& c) {
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

/// Balanced k-d tree of some corners of a polygon, each of which is active or not. A search visits only subtrees
/// with active corners whose bounding box overlaps the triangle, so that neither clustered nor repeated positions
/// make it slow.
class ReflexCornerTree {
public:
    /// All corners are active at first.
    /// \param points   positions of all corners of the polygon, in [-1, 1]; borrowed
    /// \param corners  indices of the corners of the tree
    /// O(n log n)
    ReflexCornerTree(const std::vector<PlanarPoint>& points, std::span<const Index> corners)
        : points_(points),
          corners_(corners.begin(), corners.end()),
          leaf_of_(points.size(), no_index),
          is_active_(points.size(), 0) {
        if (!corners_.empty()) build(0, static_cast<Index>(corners_.size()), no_index);
        for (const Index corner : corners_) is_active_[corner] = 1;
    }

    /// Changes the state of a corner; without effect on corners that the tree does not have. O(log n)
    void set_active(Index corner, bool active) {
        if (leaf_of_[corner] == no_index || (is_active_[corner] != 0) == active) return;
        is_active_[corner] = active;
        for (Index i = leaf_of_[corner]; i != no_index; i = nodes_[i].parent)
            nodes_[i].active += active ? Index{1} : static_cast<Index>(-1);
    }

    /// Returns an active corner in the closed triangle, or no_index if there is none. Corners at the position of a
    /// corner of the triangle do not count.
    /// \param triangle  counter-clockwise
    /// O(log n) if few corners are near the boundary of the triangle, O(sqrt n) for uniformly distributed corners
    Index find_in(const std::array<PlanarPoint, 3>& triangle) const {
        if (nodes_.empty()) return no_index;
        const auto& [a, b, c] = triangle;
        Box bounds;
        for (std::size_t k = 0; k < 2; ++k) {
            bounds.low[k] = std::min({a[k], b[k], c[k]}) - rounding_margin;
            bounds.high[k] = std::max({a[k], b[k], c[k]}) + rounding_margin;
        }
        return find_below(nodes_[0], triangle, bounds);
    }

private:
    static constexpr Index leaf_size = 4;
    // Far above the rounding errors of coordinates in [-1, 1].
    static constexpr double rounding_margin = 1e-12;

    struct Box {
        PlanarPoint low, high;
    };
    struct Node {
        Box box;
        /// Corners of a parallelogram around the corners of the subtree. It is narrower than the box for corners
        /// along a slanted line.
        std::array<PlanarPoint, 4> outline;
        Index first = 0, last = 0;  ///< range in corners_
        Index parent = no_index;
        Index left = no_index, right = no_index;  ///< no_index: a leaf
        Index active = 0;                         ///< number of active corners
    };

    static bool overlap(const Box& one, const Box& other) {
        return one.low[0] <= other.high[0] && other.low[0] <= one.high[0] && one.low[1] <= other.high[1] &&
               other.low[1] <= one.high[1];
    }

    /// Whether orient2d(a, b, p) is negative for all points p of a subtree.
    static bool is_right_of(const PlanarPoint& a, const PlanarPoint& b, const Node& node) {
        // The roundings of orient2d() are monotonic in each coordinate: if the result is negative for this corner of
        // the box, then also for each point in the box.
        const PlanarPoint leftmost = {b[1] - a[1] > 0 ? node.box.low[0] : node.box.high[0],
                                      b[0] - a[0] > 0 ? node.box.high[1] : node.box.low[1]};
        if (orient2d(a, b, leftmost) < 0) return true;
        // Above the rounding errors of the outline and of the distance from the line.
        constexpr double rounding = 4e-15;
        const double tolerance = rounding * (std::abs(b[0] - a[0]) + std::abs(b[1] - a[1]));
        return std::ranges::all_of(node.outline,
                                   [&](const PlanarPoint& p) { return orient2d(a, b, p) < -tolerance; });
    }

    Index build(Index first, Index last, Index parent) {
        const auto index = static_cast<Index>(nodes_.size());
        const Box box = bounding_box(first, last);
        const std::size_t axis = box.high[0] - box.low[0] >= box.high[1] - box.low[1] ? 0 : 1;
        nodes_.push_back(
            {box, outline(first, last, axis), first, last, parent, no_index, no_index, last - first});
        if (last - first <= leaf_size || box.low == box.high) {
            for (Index i = first; i < last; ++i) leaf_of_[corners_[i]] = index;
            return index;
        }
        const Index middle = first + (last - first) / 2;
        std::nth_element(corners_.begin() + first, corners_.begin() + middle, corners_.begin() + last,
                         [&](Index a, Index b) {
                             const double x = points_[a][axis], y = points_[b][axis];
                             return x != y ? x < y : a < b;
                         });
        const Index left = build(first, middle, index), right = build(middle, last, index);
        nodes_[index].left = left;
        nodes_[index].right = right;
        return index;
    }

    Box bounding_box(Index first, Index last) const {
        Box box = {points_[corners_[first]], points_[corners_[first]]};
        for (Index i = first; i < last; ++i) {
            for (std::size_t k = 0; k < 2; ++k) {
                box.low[k] = std::min(box.low[k], points_[corners_[i]][k]);
                box.high[k] = std::max(box.high[k], points_[corners_[i]][k]);
            }
        }
        return box;
    }

    std::array<PlanarPoint, 4> outline(Index first, Index last, std::size_t axis) const {
        const auto along = [&](Index i) { return points_[corners_[i]][axis]; };
        const auto across = [&](Index i) { return points_[corners_[i]][1 - axis]; };
        Index low = first, high = first;
        for (Index i = first; i < last; ++i) {
            if (along(i) < along(low)) low = i;
            if (along(i) > along(high)) high = i;
        }
        const double length = along(high) - along(low);
        const double slope = length > 0 ? (across(high) - across(low)) / length : 0;
        std::pair<double, double> straight(2, -2), slanted(4, -4);  // ranges of the distance across the axis
        for (Index i = first; i < last; ++i) {
            const double distance = across(i) - slope * (along(i) - along(low));
            slanted = {std::min(slanted.first, distance), std::max(slanted.second, distance)};
            straight = {std::min(straight.first, across(i)), std::max(straight.second, across(i))};
        }
        const bool is_slanted = slanted.second - slanted.first < straight.second - straight.first;
        const auto& [near, far] = is_slanted ? slanted : straight;
        const double rise = is_slanted ? slope * length : 0;
        std::array<PlanarPoint, 4> result;
        for (std::size_t k = 0; k < 4; ++k) {
            result[k][axis] = k < 2 ? along(low) : along(high);
            result[k][1 - axis] = (k % 2 ? far : near) + (k < 2 ? 0 : rise);
        }
        return result;
    }

    Index find_below(const Node& node, const std::array<PlanarPoint, 3>& triangle, const Box& bounds) const {
        const auto& [a, b, c] = triangle;
        const bool is_at_corner =
            node.box.low == node.box.high && (node.box.low == a || node.box.low == b || node.box.low == c);
        if (node.active == 0 || is_at_corner || !overlap(node.box, bounds) || is_right_of(a, b, node) ||
            is_right_of(b, c, node) || is_right_of(c, a, node))
            return no_index;
        if (node.left != no_index) {
            const Index found = find_below(nodes_[node.left], triangle, bounds);
            return found != no_index ? found : find_below(nodes_[node.right], triangle, bounds);
        }
        for (Index i = node.first; i < node.last; ++i) {
            const PlanarPoint& p = points_[corners_[i]];
            if (is_active_[corners_[i]] && p != a && p != b && p != c && overlap({p, p}, bounds) &&
                orient2d(a, b, p) >= 0 && orient2d(b, c, p) >= 0 && orient2d(c, a, p) >= 0)
                return corners_[i];
        }
        return no_index;
    }

    const std::vector<PlanarPoint>& points_;
    std::vector<Index> corners_;  // sorted by leaf
    std::vector<Index> leaf_of_;  // per corner of the polygon; no_index: not in the tree
    std::vector<std::uint8_t> is_active_;
    std::vector<Node> nodes_;
};

}  // namespace faqem::detail
