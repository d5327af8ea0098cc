#pragma once
// Meshes whose faces have corners of their own, which differ by rounding.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <utility>

#include "support/meshes.hpp"

namespace faqem::test {

/// Every face with three vertices of its own. Each coordinate is off by up to `units` times the rounding of a float
/// of the size of the largest coordinate, and rounded to a float.
inline TriangleMesh float_soup(const TriangleMesh& mesh, double units) {
    double largest = 0;
    for (const Vec3& p : mesh.positions)
        for (const double x : p) largest = std::max(largest, std::abs(x));
    const auto size = static_cast<float>(largest);
    const double unit =
        static_cast<double>(std::nextafter(size, std::numeric_limits<float>::max())) - double{size};
    Random random(7);
    TriangleMesh result = separated(mesh);
    for (Vec3& p : result.positions)
        for (double& x : p) x = static_cast<float>(x + unit * random.between(-units, units));
    return result;
}

/// The number of edges of one face, where vertices at equal positions are one.
inline std::uint64_t open_edges(const TriangleMesh& mesh) {
    std::map<std::pair<Vec3, Vec3>, int> faces;
    for (const Triangle& t : mesh.triangles)
        for (std::size_t c = 0; c < 3; ++c)
            ++faces[std::minmax(mesh.positions[t[c]], mesh.positions[t[(c + 1) % 3]])];
    return static_cast<std::uint64_t>(
        std::count_if(faces.begin(), faces.end(), [](const auto& edge) { return edge.second == 1; }));
}

}  // namespace faqem::test
