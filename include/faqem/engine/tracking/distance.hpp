#pragma once
/// \file
/// Squared distances from many points to a triangle or segment, or to the nearest of several.

#include <algorithm>
#include <cstddef>
#include <limits>
#include <vector>

#include "faqem/engine/mesh/vector.hpp"
#include "faqem/export.hpp"

FAQEM_NAMESPACE_BEGIN
namespace engine {

/// Squared distance to a triangle, with precomputed terms. The triangle may be a sliver, a segment or a
/// point.
class TriangleDistance {
public:
    TriangleDistance(const Vector3& a, const Vector3& b, const Vector3& c)
        : a_(a), ab_(b - a), ac_(c - a), bc_(c - b) {
        ab2_ = ab_.squaredNorm(), ac2_ = ac_.squaredNorm(), ab_ac_ = ab_.dot(ac_);
        const double det = ab2_ * ac2_ - ab_ac_ * ab_ac_;
        if (det > min_sine_squared * ab2_ * ac2_) inv_det_ = 1 / det;
        inv_ab2_ = inverse(ab2_), inv_ac2_ = inverse(ac2_), inv_bc2_ = inverse(bc_.squaredNorm());
    }

    /// Squared distance from p to the triangle. O(1)
    double operator()(const Vector3& p) const {
        const Vector3 from_a = p - a_, from_b = from_a - ab_;
        const double along_ab = ab_.dot(from_a), along_ac = ac_.dot(from_a);
        const double v = (ac2_ * along_ab - ab_ac_ * along_ac) * inv_det_;
        const double w = (ab2_ * along_ac - ab_ac_ * along_ab) * inv_det_;
        if (inv_det_ > 0 && v >= 0 && w >= 0 && v + w <= 1) return (from_a - v * ab_ - w * ac_).squaredNorm();
        // The closest point is on a side beyond which p lies. Sides for which this is uncertain due to
        // rounding are tested as well.
        const bool is_sliver = !(inv_det_ > 0);
        double nearest = std::numeric_limits<double>::infinity();
        if (is_sliver || !(w >= barycentric_tolerance))
            nearest = (from_a - clamp_to_unit(along_ab * inv_ab2_) * ab_).squaredNorm();
        if (is_sliver || !(v >= barycentric_tolerance))
            nearest = std::min(nearest, (from_a - clamp_to_unit(along_ac * inv_ac2_) * ac_).squaredNorm());
        if (is_sliver || !(v + w <= 1 - barycentric_tolerance))
            nearest =
                std::min(nearest, (from_b - clamp_to_unit(bc_.dot(from_b) * inv_bc2_) * bc_).squaredNorm());
        return nearest;
    }

private:
    /// If the squared sine of the angle at a is at most this, only the sides are used.
    static constexpr double min_sine_squared = 1e-14;
    /// Larger than the rounding errors of v and w for triangles above that limit.
    static constexpr double barycentric_tolerance = 0.05;

    static double inverse(double x) { return x > 0 ? 1 / x : 0; }
    static double clamp_to_unit(double t) { return std::clamp(t, 0.0, 1.0); }

    Vector3 a_, ab_, ac_, bc_;
    double ab2_ = 0, ac2_ = 0, ab_ac_ = 0;
    double inv_det_ = 0, inv_ab2_ = 0, inv_ac2_ = 0, inv_bc2_ = 0;  // reciprocals; 0 if undefined
};

/// Squared distance to a segment, with precomputed terms. A segment of length 0 is a point.
class SegmentDistance {
public:
    SegmentDistance(const Vector3& a, const Vector3& b) : a_(a), ab_(b - a) {
        const double square = ab_.squaredNorm();
        if (square > 0) inv_square_ = 1 / square;
    }

    /// Squared distance from p to the segment. O(1)
    double operator()(const Vector3& p) const {
        const Vector3 from_a = p - a_;
        return (from_a - std::clamp(ab_.dot(from_a) * inv_square_, 0.0, 1.0) * ab_).squaredNorm();
    }

private:
    Vector3 a_, ab_;
    double inv_square_ = 0;
};

/// Index of the shape nearest to a point. O(shapes)
/// \tparam Shape  TriangleDistance or SegmentDistance
/// \return the first one of several at the same distance; 0 if there are no shapes
template <class Shape>
std::size_t nearest_index(const std::vector<Shape>& shapes, const Vector3& p) {
    std::size_t at = 0;
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < shapes.size(); ++k) {
        const double d = shapes[k](p);
        if (d < nearest) nearest = d, at = k;
    }
    return at;
}

/// Largest squared distance of a set of points from their respective nearest shape (one-sided Hausdorff
/// distance). Points in succession often have the same nearest shape, so the last one is tested first; a
/// point is done as soon as a shape is at most the current maximum away.
/// \tparam Shape  TriangleDistance or SegmentDistance
template <class Shape>
class FarthestPoint {
public:
    /// \param shapes  at least one; borrowed, must outlive this object
    explicit FarthestPoint(const std::vector<Shape>& shapes) : shapes_(shapes) {}

    /// Adds a point. O(shapes) at worst, typically one distance
    void add(const Vector3& p) {
        double nearest = std::numeric_limits<double>::infinity();
        for (std::size_t j = 0; j < shapes_.size() && nearest > worst_; ++j) {
            const std::size_t k = first_ + j < shapes_.size() ? first_ + j : first_ + j - shapes_.size();
            const double d = shapes_[k](p);
            if (d < nearest) nearest = d;
            if (d <= worst_) first_ = k;
        }
        if (nearest > worst_) worst_ = nearest;
    }

    /// The largest squared distance of the points added so far; 0 without points.
    double squared_distance() const { return worst_; }

private:
    const std::vector<Shape>& shapes_;
    double worst_ = 0;
    std::size_t first_ = 0;
};

}  // namespace engine
FAQEM_NAMESPACE_END
