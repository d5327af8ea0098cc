// Transfers a quantity at the vertices of the original (a temperature, for example, or a bone weight) to the
// simplified mesh and back.

#include <cmath>
#include <iostream>
#include <stdexcept>

#include "faqem/asset.hpp"
#include "faqem/forward_map.hpp"
#include "faqem/simplify.hpp"
#include "faqem/surface_map.hpp"

// Interpolates the quantity at a point of a face.
double interpolate(const std::vector<double>& values, const faqem::Triangle& t,
                   const faqem::Vec3& barycentric) {
    return barycentric[0] * values[t[0]] + barycentric[1] * values[t[1]] + barycentric[2] * values[t[2]];
}

int main(int argc, char** argv) try {
    if (argc != 2) throw std::invalid_argument("usage: field_transfer IN");
    const faqem::Asset model = faqem::load(argv[1]);
    const faqem::Part& original = model.parts.at(0);
    std::vector<double> temperature;  // per vertex of the original, in [0, 1]
    for (const faqem::Vec3& p : original.positions)
        temperature.push_back(0.5 + 0.5 * std::sin(2 * p[0] + p[1]));

    const auto simplified = faqem::simplify({original.positions, original.triangles},
                                            {.target = faqem::ratio(0.2), .history = faqem::Recording::on});

    // To the simplified mesh: each of its vertices is mapped to the original.
    const faqem::SurfaceMap to_original(simplified.history);
    std::vector<double> simplified_temperature(simplified.mesh.positions.size(), 0);
    for (faqem::Index f = 0; f < simplified.mesh.triangles.size(); ++f) {
        for (std::size_t k = 0; k < 3; ++k) {
            faqem::Vec3 corner = {};
            corner[k] = 1;
            const faqem::SurfacePoint point = to_original.map(f, corner);
            simplified_temperature[simplified.mesh.triangles[f][k]] =
                interpolate(temperature, original.triangles[point.face], point.barycentric);
        }
    }

    // And back: the first corner of each original face is mapped to the simplified mesh.
    const faqem::ForwardMap to_simplified(simplified.history);
    double sum = 0;
    std::size_t count = 0, unmapped = 0;
    for (faqem::Index f = 0; f < original.triangles.size(); ++f) {
        const faqem::SimplifiedPoint point = to_simplified.map(f, {1, 0, 0});
        if (point.face == faqem::no_index && ++unmapped) continue;
        sum += std::abs(
            interpolate(simplified_temperature, simplified.mesh.triangles[point.face], point.barycentric) -
            temperature[original.triangles[f][0]]);
        ++count;
    }
    std::cout << simplified.mesh.triangles.size() << " faces; mean difference after both transfers "
              << sum / static_cast<double>(count) << ", " << unmapped << " points not mapped\n";
    return sum < 0.02 * static_cast<double>(count) ? 0 : 1;
} catch (const std::exception& error) {
    std::cerr << "field_transfer: " << error.what() << "\n";
    return 1;
}
