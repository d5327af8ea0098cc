#pragma once
/// \file
/// Points on a simplified mesh and on the original, for tests of the map between them.

#include <cmath>
#include <vector>

#include "faqem/surface_map.hpp"

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

/// Barycentric coordinates of a regular grid over a triangle, including its edges and corners.
/// \param n  number of intervals along an edge, > 0
inline std::vector<Vec3> spread(int n) {
    std::vector<Vec3> result;
    for (int i = 0; i <= n; ++i) {
        for (int j = 0; i + j <= n; ++j) {
            result.push_back({i / double(n), j / double(n), (n - i - j) / double(n)});
        }
    }
    return result;
}

/// Faces of a grid of n x n squares with vertices vertex(i, j). Of each square, the even face is below the
/// diagonal.
template <class Vertex>
std::vector<Triangle> grid_faces(Index n, Vertex&& vertex) {
    std::vector<Triangle> faces;
    for (Index j = 0; j < n; ++j) {
        for (Index i = 0; i < n; ++i) {
            faces.push_back({vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1)});
            faces.push_back({vertex(i, j), vertex(i + 1, j + 1), vertex(i, j + 1)});
        }
    }
    return faces;
}

}  // namespace faqem::test
