#pragma once
/// \file
/// Brute-force distances between meshes, for comparison.

#include <algorithm>
#include <cmath>
#include <limits>

#include "faqem/detail/geometry/triangle.hpp"
#include "faqem/engine/mesh/vector.hpp"
#include "faqem/mesh.hpp"

namespace faqem::test {

/// Largest distance from the points of a regular grid on each face of `from`, including corners, to the faces
/// of `to`.
/// \param steps  number of intervals along an edge, > 0
inline double sampled_distance(const TriangleMesh& from, const TriangleMesh& to, int steps) {
    const auto corner = [](const TriangleMesh& mesh, const Triangle& t, std::size_t k) {
        return engine::to_eigen(mesh.positions[t[k]]);
    };
    double largest = 0;
    for (const Triangle& t : from.triangles) {
        for (int i = 0; i <= steps; ++i) {
            for (int j = 0; i + j <= steps; ++j) {
                const engine::Vector3 p =
                    (i * corner(from, t, 0) + j * corner(from, t, 1) + (steps - i - j) * corner(from, t, 2)) /
                    steps;
                double nearest = std::numeric_limits<double>::infinity();
                for (const Triangle& u : to.triangles) {
                    nearest = std::min(nearest, detail::closest_point_on_triangle(
                                                    p, corner(to, u, 0), corner(to, u, 1), corner(to, u, 2))
                                                    .distance_squared);
                }
                largest = std::max(largest, nearest);
            }
        }
    }
    return std::sqrt(largest);
}

}  // namespace faqem::test
