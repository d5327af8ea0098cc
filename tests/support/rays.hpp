#pragma once
/// \file
/// Where rays meet a mesh.

#include <Eigen/Dense>
#include <algorithm>
#include <vector>

#include "faqem/engine/mesh/vector.hpp"
#include "faqem/mesh.hpp"

namespace faqem::test {

/// Distances, in lengths of `direction`, at which a ray from a point meets the faces; ascending.
/// \param mesh  has positions and triangles
template <class Mesh>
std::vector<double> ray_hits(const Mesh& mesh, const Vec3& from, const Vec3& direction) {
    std::vector<double> hits;
    for (const Triangle& t : mesh.triangles) {
        Eigen::Matrix3d corners;
        for (int k = 0; k < 3; ++k) {
            const Vec3& p = mesh.positions[t[static_cast<std::size_t>(k)]];
            corners.col(k) = engine::to_eigen(p) - engine::to_eigen(from);
        }
        // The direction is this combination of the corners.
        const Eigen::Vector3d x = corners.inverse() * engine::to_eigen(direction);
        if (x.minCoeff() >= -1e-9) hits.push_back(1 / x.sum());
    }
    std::ranges::sort(hits);
    return hits;
}

}  // namespace faqem::test
