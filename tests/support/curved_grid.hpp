#pragma once
// A mesh with all attributes that compression rounds.

#include <cmath>

#include "support/format_support.hpp"
#include "support/meshes.hpp"

namespace faqem::testing {

/// A curved grid with normals, tangents and texture coordinates.
inline Asset curved_grid(FileOrder order) {
    const TriangleMesh grid = test::grid(24);
    Asset asset = one_part({}, grid.triangles);
    Part& part = asset.parts[0];
    part.file_order = order;
    part.uvs.resize(1);
    for (const Vec3& p : grid.positions) {
        const double x = p[0] / 7, y = p[1] / 11;
        part.positions.push_back(
            {static_cast<float>(x), static_cast<float>(y), static_cast<float>(std::sin(x * y))});
        const double length = std::sqrt(1 + x * x + y * y);
        part.normals.push_back({static_cast<float>(x / length), static_cast<float>(-y / length),
                                static_cast<float>(1 / length)});
        part.tangents.push_back({static_cast<float>(std::cos(x)), static_cast<float>(std::sin(x)), 0, 1});
        part.uvs[0].push_back({static_cast<float>(x / 3), static_cast<float>(1.7 - y)});
    }
    return asset;
}

}  // namespace faqem::testing
