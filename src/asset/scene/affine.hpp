#pragma once
/// \file
/// Affine transforms of points and normals, as column-major 4 x 4 matrices (Instance::transform).

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "faqem/detail/base/portable_math.hpp"
#include "faqem/mesh.hpp"

namespace faqem::detail {

/// A column-major 4 x 4 matrix.
using Matrix4 = std::array<double, 16>;

/// The transform of an instance that is not moved.
inline constexpr Matrix4 identity_transform = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};

inline Vec3 transformed_point(const Matrix4& m, const Vec3& p) {
    Vec3 q;
    for (std::size_t r = 0; r < 3; ++r) q[r] = m[r] * p[0] + m[4 + r] * p[1] + m[8 + r] * p[2] + m[12 + r];
    return q;
}

/// The larger of two values, or NaN if one of them is NaN.
inline double max_or_nan(double a, double b) { return std::isnan(a) || a >= b ? a : b; }

/// A bound of the absolute coordinates of transformed points; NaN or infinity if they may be outside the range of double.
/// \param largest  largest absolute coordinate of the points
inline double transformed_bound(const Matrix4& m, double largest) {
    double bound = 0;
    for (std::size_t r = 0; r < 3; ++r) {
        const double row =
            (std::abs(m[r]) + std::abs(m[4 + r]) + std::abs(m[8 + r])) * largest + std::abs(m[12 + r]);
        bound = max_or_nan(bound, row);
    }
    return bound;
}

/// Mean squared singular value of the linear part.
inline double squared_scale(const Matrix4& m) {
    double squares = 0;
    for (const std::size_t column : {0u, 4u, 8u})
        for (std::size_t row = 0; row < 3; ++row) squares += m[column + row] * m[column + row];
    return squares / 3;
}

/// Transforms normals by the inverse transpose of the linear part, and normalises them. Those of mirroring transforms
/// point to the same side as the face normals of faces whose winding is reversed. Defined for singular transforms too.
class NormalTransform {
public:
    explicit NormalTransform(const Matrix4& m) {
        const auto at = [&](std::size_t r, std::size_t col) { return m[4 * (col % 3) + r % 3]; };
        for (std::size_t r = 0; r < 3; ++r)
            for (std::size_t k = 0; k < 3; ++k)
                cofactors_[r][k] = at(r + 1, k + 1) * at(r + 2, k + 2) - at(r + 1, k + 2) * at(r + 2, k + 1);
        const double determinant =
            m[0] * cofactors_[0][0] + m[1] * cofactors_[1][0] + m[2] * cofactors_[2][0];
        sign_ = determinant < 0 ? -1 : 1;
    }

    /// Whether the transform mirrors.
    bool is_mirrored() const { return sign_ < 0; }

    /// The unit normal; zero if it is zero or not finite.
    Vec3f operator()(const Vec3f& n) const {
        Vec3 q;
        for (std::size_t r = 0; r < 3; ++r)
            q[r] = sign_ * (cofactors_[r][0] * n[0] + cofactors_[r][1] * n[1] + cofactors_[r][2] * n[2]);
        const double length = portable_length(q[0], q[1], q[2]);
        if (!(length > 0 && std::isfinite(length))) return {0, 0, 0};
        return {static_cast<float>(q[0] / length), static_cast<float>(q[1] / length),
                static_cast<float>(q[2] / length)};
    }

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

/// The numbers of an array as those of another type.
template <class To, class From, std::size_t N>
std::array<To, N> converted(const std::array<From, N>& numbers) {
    std::array<To, N> result;
    std::ranges::transform(numbers, result.begin(), [](From x) { return static_cast<To>(x); });
    return result;
}

// Arithmetic of vectors, since the readers and writers are compiled without Eigen.
inline Vec3 minus(const Vec3& a, const Vec3& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
inline double dot(const Vec3& a, const Vec3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
inline Vec3 cross(const Vec3& a, const Vec3& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// Adds a multiple of a vector.
template <class T>
void add_scaled(Vec3& to, double factor, const std::array<T, 3>& v) {
    for (std::size_t k = 0; k < 3; ++k) to[k] += factor * v[k];
}

}  // namespace faqem::detail
