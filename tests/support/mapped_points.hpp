#pragma once
/// \file
/// Points on a simplified mesh and on the original, for tests of the map between them.

#include <cmath>

#include "faqem/surface_map.hpp"
#include "support/meshes.hpp"

namespace faqem::test {

/// The linear combination of three points with weights w.
inline Vec3 mix(const Vec3& w, const Vec3& a, const Vec3& b, const Vec3& c) {
    Vec3 p;
    for (std::size_t i = 0; i < 3; ++i) p[i] = w[0] * a[i] + w[1] * b[i] + w[2] * c[i];
    return p;
}

/// The point with barycentric coordinates w on a face of the simplified mesh.
inline Vec3 small_point(const TriangleMesh& mesh, Index face, const Vec3& w) {
    const Triangle& t = mesh.triangles[face];
    return mix(w, mesh.positions[t[0]], mesh.positions[t[1]], mesh.positions[t[2]]);
}

/// The position of a point on the original.
inline Vec3 original_point(const CollapseHistory& history, const SurfacePoint& p) {
    const Triangle& t = history.triangles[p.face];
    return mix(p.barycentric, history.positions[t[0]], history.positions[t[1]], history.positions[t[2]]);
}

inline double distance(const Vec3& a, const Vec3& b) {
    return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

}  // namespace faqem::test
