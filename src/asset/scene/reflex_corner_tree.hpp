#pragma once
/// \file
/// Search for corners of a polygon that lie in a triangle.

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
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
    ReflexCornerTree(const std::vector<PlanarPoint>& points, std::span<const Index> corners);

    /// Changes the state of a corner; without effect on corners that the tree does not have. O(log n)
    void set_active(Index corner, bool active);

    /// Returns an active corner in the closed triangle, or no_index if there is none. Corners at the position of a
    /// corner of the triangle do not count.
    /// \param triangle  counter-clockwise
    /// O(log n) if few corners are near the boundary of the triangle, O(sqrt n) for uniformly distributed corners
    Index find_in(const std::array<PlanarPoint, 3>& triangle) const;

private:
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

    static bool overlap(const Box& one, const Box& other);
    /// Whether orient2d(a, b, p) is negative for all points p of a subtree.
    static bool is_right_of(const PlanarPoint& a, const PlanarPoint& b, const Node& node);
    Index build(Index first, Index last, Index parent);
    Box bounding_box(Index first, Index last) const;
    std::array<PlanarPoint, 4> outline(Index first, Index last, std::size_t axis) const;
    Index find_below(const Node& node, const std::array<PlanarPoint, 3>& triangle, const Box& bounds) const;

    const std::vector<PlanarPoint>& points_;
    std::vector<Index> corners_;  // sorted by leaf
    std::vector<Index> leaf_of_;  // per corner of the polygon; no_index: not in the tree
    std::vector<std::uint8_t> is_active_;
    std::vector<Node> nodes_;
};

}  // namespace faqem::detail
