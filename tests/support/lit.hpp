#pragma once
/// \file
/// Shading normals from a normal map, as viewers compute them.

#include <numbers>

#include "support/scenes.hpp"

namespace faqem::test {

using Direction = std::array<double, 3>;

inline Direction unit(Direction a) {
    const double length = std::hypot(a[0], a[1], a[2]);
    return {a[0] / length, a[1] / length, a[2] / length};
}

inline Direction cross(const Direction& a, const Direction& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

inline double degrees_between(const Direction& a, const Direction& b) {
    const Direction c = cross(a, b);
    const double dot = a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    return std::atan2(std::hypot(c[0], c[1], c[2]), dot) * 180 / std::numbers::pi;
}

/// The shading normal at a point of a face: the normal map in the frame of NORMAL and TANGENT (glTF).
/// \param w  barycentric coordinates
inline Direction lit_normal(const Part& part, const Pixels& map, std::size_t face, const Vec3& w) {
    const Triangle& t = part.triangles[face];
    const auto n = blend(part.normals, t, w);
    const auto tangent = blend(part.tangents, t, w);
    const Direction normal = unit(n), along = unit({tangent[0], tangent[1], tangent[2]});
    const double side = part.tangents[t[0]][3];
    const Direction across = unit(cross(normal, along));
    const auto c = look(part, map, face, w);
    Direction result{};
    for (std::size_t k = 0; k < 3; ++k) {
        result[k] = (c[0] / 127.5 - 1) * along[k] + (c[1] / 127.5 - 1) * side * across[k] +
                    (c[2] / 127.5 - 1) * normal[k];
    }
    return unit(result);
}

}  // namespace faqem::test
