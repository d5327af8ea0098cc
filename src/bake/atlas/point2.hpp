#pragma once
/// \file
/// Points, triangles and axis-aligned bounding boxes in the plane of a chart or a page.

#include <algorithm>
#include <array>
#include <span>

#include "faqem/detail/base/portable_math.hpp"

namespace faqem::detail {

/// A point or a vector in the plane.
struct Point2 {
    double x = 0, y = 0;

    bool operator==(const Point2&) const = default;
};

/// The corners of a triangle in the plane.
using Triangle2 = std::array<Point2, 3>;

/// Sum of two vectors.
constexpr Point2 operator+(const Point2& a, const Point2& b) { return {a.x + b.x, a.y + b.y}; }

/// Vector from b to a.
constexpr Point2 operator-(const Point2& a, const Point2& b) { return {a.x - b.x, a.y - b.y}; }

/// Vector scaled by a factor.
constexpr Point2 operator*(const Point2& a, double factor) { return {a.x * factor, a.y * factor}; }

/// Dot product.
constexpr double dot(const Point2& a, const Point2& b) { return a.x * b.x + a.y * b.y; }

/// Cross product: positive if b is counter-clockwise from a.
constexpr double cross(const Point2& a, const Point2& b) { return a.x * b.y - a.y * b.x; }

/// Euclidean length, without overflow or underflow of the squares.
inline double length(const Point2& a) { return portable_length(a.x, a.y, 0); }

/// Square of the Euclidean length.
constexpr double squared_length(const Point2& a) { return a.x * a.x + a.y * a.y; }

/// The vector `a` rotated counter-clockwise by the angle between the x axis and the unit vector `direction`.
constexpr Point2 rotated(const Point2& a, const Point2& direction) {
    return {a.x * direction.x - a.y * direction.y, a.x * direction.y + a.y * direction.x};
}

/// Twice the signed area of the triangle (a, b, c); positive if it is counter-clockwise.
constexpr double twice_signed_area(const Point2& a, const Point2& b, const Point2& c) {
    return cross(b - a, c - a);
}

/// The point with parameter t on the line through a (t = 0) and b (t = 1).
constexpr Point2 point_on_line(const Point2& a, const Point2& b, double t) { return a + (b - a) * t; }

/// Parameter of the point of the segment from a (0) to b (1) that is closest to p; 0 if a equals b.
constexpr double closest_on_segment(const Point2& a, const Point2& b, const Point2& p) {
    const double squared = squared_length(b - a);
    return squared > 0 ? std::clamp(dot(b - a, p - a) / squared, 0.0, 1.0) : 0;
}

/// Squared distance between p and the point of the segment from a to b that is closest to it.
constexpr double squared_distance_to_segment(const Point2& a, const Point2& b, const Point2& p) {
    return squared_length(point_on_line(a, b, closest_on_segment(a, b, p)) - p);
}

/// Axis-aligned bounding box in the plane; by default empty.
struct Box2 {
    Point2 low = {HUGE_VAL, HUGE_VAL}, high = {-HUGE_VAL, -HUGE_VAL};

    /// Extends the box to contain p.
    constexpr void add(const Point2& p) {
        low = {std::min(low.x, p.x), std::min(low.y, p.y)};
        high = {std::max(high.x, p.x), std::max(high.y, p.y)};
    }
    /// The box extended by `margin` on all sides.
    constexpr Box2 expanded(double margin) const {
        return {{low.x - margin, low.y - margin}, {high.x + margin, high.y + margin}};
    }
    /// Extent along the x axis.
    constexpr double width() const { return high.x - low.x; }
    /// Extent along the y axis.
    constexpr double height() const { return high.y - low.y; }
    /// The larger of width and height.
    constexpr double size() const { return std::max(width(), height()); }
};

/// Least and largest x at which the edges of a triangle cross the line at `y`; infinity and -infinity if none does.
/// \tparam Point  has coordinates x and y
template <class Point>
std::array<double, 2> crossing_range(const std::array<Point, 3>& t, double y) {
    std::array<double, 2> range = {HUGE_VAL, -HUGE_VAL};
    for (std::size_t k = 0; k < 3; ++k) {
        const Point &p = t[k], &q = t[(k + 1) % 3];
        if ((p.y <= y) == (q.y <= y)) continue;
        const double x = p.x + (y - p.y) / (q.y - p.y) * (q.x - p.x);
        range = {std::min(range[0], x), std::max(range[1], x)};
    }
    return range;
}

/// Bounding box of at least one point.
inline Box2 bounding_box(std::span<const Point2> points) {
    const auto [left, right] = std::ranges::minmax_element(points, {}, &Point2::x);
    const auto [bottom, top] = std::ranges::minmax_element(points, {}, &Point2::y);
    return {{left->x, bottom->y}, {right->x, top->y}};
}

}  // namespace faqem::detail
