#pragma once
/// \file
/// Closest point on a triangle; robust for slivers and for triangles that degenerate to a segment or a point.

#include <algorithm>
#include <limits>

#include "faqem/detail/base/vector.hpp"
#include "faqem/export.hpp"

FAQEM_DETAIL_BEGIN

/// The point of a triangle that is closest to a query point.
struct ClosestPoint {
    Vector3 point = Vector3::Zero();
    Vector3 barycentric = Vector3::Zero();  ///< barycentric coordinates; >= 0, sum 1
    double distance_squared = std::numeric_limits<double>::infinity();
};

namespace closest_point {

/// Result for a given point of the triangle.
inline ClosestPoint at(const Vector3& p, const Vector3& point, const Vector3& barycentric) {
    return {point, barycentric, (point - p).squaredNorm()};
}

/// Parameter in [0, 1] of the point of segment ab that is closest to p; 0 if a equals b.
inline double on_segment(const Vector3& p, const Vector3& a, const Vector3& b) {
    const Vector3 d = b - a;
    const double length_squared = d.squaredNorm();
    if (!(length_squared > 0)) return 0;
    const double t = (p - a).dot(d) / length_squared;
    if (!(t > 0)) return 0;
    return t < 1 ? t : 1;
}

/// Closest point on the three edges of a triangle.
inline ClosestPoint on_boundary(const Vector3& p, const Vector3& a, const Vector3& b, const Vector3& c) {
    const double s = on_segment(p, a, b), t = on_segment(p, b, c), u = on_segment(p, c, a);
    // Returns the corners themselves at both ends, because a + 1 (b - a) may differ from b in floating point.
    const auto mix = [](const Vector3& from, const Vector3& to, double x) -> Vector3 {
        if (x == 0) return from;
        if (x == 1) return to;
        return from + x * (to - from);
    };
    ClosestPoint best = at(p, mix(a, b, s), {1 - s, s, 0});
    for (const ClosestPoint& other : {at(p, mix(b, c, t), {0, 1 - t, t}), at(p, mix(c, a, u), {u, 0, 1 - u})})
        if (other.distance_squared < best.distance_squared) best = other;
    return best;
}

/// Approximately the sine of the smallest angle below which the interior formula loses half of its digits.
inline constexpr double sliver_ratio = 1e-6;

}  // namespace closest_point

/// Finds the point of triangle abc that is closest to p, by Voronoi regions. The formula for interior points
/// divides by the squared area; for thin and degenerate triangles, the closest point on the edges is
/// therefore computed as well, and the closer of the two is returned. If the result is a corner, it is
/// bitwise equal to that corner.
/// \param p      finite
/// \param a,b,c  corners, finite; may coincide
/// O(1). Source: Ericson, Real-Time Collision Detection, 5.1.5
inline ClosestPoint closest_point_on_triangle(const Vector3& p, const Vector3& a, const Vector3& b,
                                              const Vector3& c) {
    using namespace closest_point;
    const Vector3 ab = b - a, ac = c - a, bc = c - b;
    const double longest = std::max({ab.squaredNorm(), ac.squaredNorm(), bc.squaredNorm()});
    const double area_squared = ab.cross(ac).squaredNorm();
    const bool well_shaped = area_squared > sliver_ratio * sliver_ratio * longest * longest;

    const Vector3 ap = p - a;
    const double d1 = ab.dot(ap), d2 = ac.dot(ap);
    const Vector3 bp = p - b;
    const double d3 = ab.dot(bp), d4 = ac.dot(bp);
    const Vector3 cp = p - c;
    const double d5 = ab.dot(cp), d6 = ac.dot(cp);
    const double vc = d1 * d4 - d3 * d2, vb = d5 * d2 - d1 * d6, va = d3 * d6 - d5 * d4;
    if (well_shaped) {
        if (d1 <= 0 && d2 <= 0) return at(p, a, {1, 0, 0});
        if (d3 >= 0 && d4 <= d3) return at(p, b, {0, 1, 0});
        if (d6 >= 0 && d5 <= d6) return at(p, c, {0, 0, 1});
        if (vc <= 0 && d1 >= 0 && d3 <= 0) {
            const double t = d1 / (d1 - d3);
            return at(p, a + t * ab, {1 - t, t, 0});
        }
        if (vb <= 0 && d2 >= 0 && d6 <= 0) {
            const double t = d2 / (d2 - d6);
            return at(p, a + t * ac, {1 - t, 0, t});
        }
        const double e = d4 - d3, f = d5 - d6;
        if (va <= 0 && e >= 0 && f >= 0) {
            const double t = e / (e + f);
            return at(p, b + t * bc, {0, 1 - t, t});
        }
        if (va > 0 && vb > 0 && vc > 0) {
            const double sum = va + vb + vc, v = vb / sum, w = vc / sum;
            return at(p, a + v * ab + w * ac, {va / sum, v, w});
        }
        return on_boundary(p, a, b, c);  // because of rounding, no region contains the query point
    }
    if (!(va > 0 && vb > 0 && vc > 0)) return on_boundary(p, a, b, c);
    const double sum = va + vb + vc, v = vb / sum, w = vc / sum;
    const ClosestPoint edge = on_boundary(p, a, b, c), inside = at(p, a + v * ab + w * ac, {va / sum, v, w});
    return inside.distance_squared < edge.distance_squared ? inside : edge;
}

/// Number of triangles without no_index corners.
inline std::size_t face_count(std::span<const Triangle> triangles) {
    return static_cast<std::size_t>(std::count_if(triangles.begin(), triangles.end(),
                                                  [](const Triangle& t) { return t[0] != no_index; }));
}

/// Is the triangle too flat to have a normal: height at most 1e-12 of its longest edge?
inline bool has_no_area(const Vec3& a, const Vec3& b, const Vec3& c) {
    // Halved, then scaled to about 1: no difference and no square leaves the range of a double.
    const Vector3 p = 0.5 * to_eigen(a);
    const Vector3 e = 0.5 * to_eigen(b) - p, f = 0.5 * to_eigen(c) - p;
    const double size = std::max(e.cwiseAbs().maxCoeff(), f.cwiseAbs().maxCoeff());
    if (!(size > 0)) return true;
    const Vector3 u = e / size, v = f / size;
    const double longest = std::max({u.squaredNorm(), v.squaredNorm(), (v - u).squaredNorm()});
    return !(u.cross(v).norm() > 1e-12 * longest);
}

FAQEM_DETAIL_END
