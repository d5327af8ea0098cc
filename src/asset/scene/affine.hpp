#pragma once
/// \file
/// Affine transforms of points and normals, as column-major 4 x 4 matrices (Instance::transform).

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "faqem/export.hpp"
#include "faqem/mesh.hpp"

namespace faqem::detail {

/// The transform of an instance that is not moved.
inline constexpr std::array<double, 16> identity_transform = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};

inline Vec3 transformed_point(const std::array<double, 16>& m, const Vec3& p) {
    Vec3 q;
    for (std::size_t r = 0; r < 3; ++r) q[r] = m[r] * p[0] + m[4 + r] * p[1] + m[8 + r] * p[2] + m[12 + r];
    return q;
}

/// The larger of two values, or NaN if one of them is NaN.
double max_or_nan(double a, double b);

/// A bound of the absolute coordinates of transformed points; NaN or infinity if they may be outside the range of double.
/// \param largest  largest absolute coordinate of the points
double transformed_bound(const std::array<double, 16>& m, double largest);

/// Transforms normals by the inverse transpose of the linear part, and normalises them. Those of mirroring transforms
/// point to the same side as the face normals of faces whose winding is reversed. Defined for singular transforms too.
class FAQEM_EXPORT NormalTransform {
public:
    explicit NormalTransform(const std::array<double, 16>& m);

    /// Whether the transform mirrors.
    bool is_mirrored() const { return sign_ < 0; }

    /// The unit normal; zero if it is zero or not finite.
    Vec3f operator()(const Vec3f& n) const;

private:
    std::array<Vec3, 3>
        cofactors_;  // of the linear part, row by row: the inverse transpose times the determinant
    double sign_;
};

/// The bounding box of points. Without a point, `low` is infinite.
struct PointBounds {
    Vec3 low = {HUGE_VAL, HUGE_VAL, HUGE_VAL}, high = {-HUGE_VAL, -HUGE_VAL, -HUGE_VAL};

    void add(const Vec3& p) {
        for (std::size_t k = 0; k < 3; ++k) {
            low[k] = std::min(low[k], p[k]);
            high[k] = std::max(high[k], p[k]);
        }
    }
};

/// The largest absolute value of a component; 0 if there are no vectors.
template <class Vectors>
double largest_component(const Vectors& vectors) {
    double most = 0;
    for (const auto& vector : vectors)
        for (const double x : vector) most = std::max(most, std::abs(x));
    return most;
}

// Arithmetic of vectors, since the readers and writers are compiled without Eigen.
inline Vec3 minus(const Vec3& a, const Vec3& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
inline double dot(const Vec3& a, const Vec3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
inline Vec3 cross(const Vec3& a, const Vec3& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

}  // namespace faqem::detail
