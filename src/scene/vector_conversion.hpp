#pragma once
/// \file
/// Conversions between the arrays of assets and Eigen vectors.

#include <cmath>
#include <span>

#include "faqem/detail/base/vector.hpp"
#include "faqem/mesh.hpp"

namespace faqem::detail {

inline Vector3 to_vector(const Vec3f& v) { return {v[0], v[1], v[2]}; }

inline Vec3f to_vec3f(const Vector3& v) {
    return {static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z())};
}

inline double triangle_area(std::span<const Vec3> positions, const Triangle& t) {
    return area_vector(positions, t).norm() / 2;
}

/// The normalized vector; zero if its length is zero or not finite.
inline Vector3 unit_or_zero(const Vector3& v) {
    const double length = v.norm();
    return length > 0 && std::isfinite(length) ? Vector3(v / length) : Vector3::Zero();
}

}  // namespace faqem::detail
