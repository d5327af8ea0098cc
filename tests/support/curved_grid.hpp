#pragma once
// A mesh with all attributes that compression rounds.

#include <cmath>

#include "support/format_support.hpp"

namespace faqem::testing {

/// A curved grid with normals, tangents and texture coordinates.
inline Asset curved_grid(FileOrder order) {
    constexpr Index n = 24;
    Asset asset = one_part({}, {});
    Part& part = asset.parts[0];
    part.file_order = order;
    part.uvs.resize(1);
    for (Index i = 0; i < (n + 1) * (n + 1); ++i) {
        const double x = static_cast<double>(i % (n + 1)) / 7, y = static_cast<double>(i / (n + 1)) / 11;
        part.positions.push_back(
            {static_cast<float>(x), static_cast<float>(y), static_cast<float>(std::sin(x * y))});
        const double length = std::sqrt(1 + x * x + y * y);
        part.normals.push_back({static_cast<float>(x / length), static_cast<float>(-y / length),
                                static_cast<float>(1 / length)});
        part.tangents.push_back({static_cast<float>(std::cos(x)), static_cast<float>(std::sin(x)), 0, 1});
        part.uvs[0].push_back({static_cast<float>(x / 3), static_cast<float>(1.7 - y)});
    }
    for (Index i = 0; i < n * n; ++i) {
        const Index v = i / n * (n + 1) + i % n;
        part.triangles.push_back({v, v + 1, v + n + 1});
        part.triangles.push_back({v + 1, v + n + 2, v + n + 1});
    }
    part.face_material.assign(part.triangles.size(), no_index);
    return asset;
}

}  // namespace faqem::testing
