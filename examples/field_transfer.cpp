// A quantity per vertex of the original (a temperature, a label's weight, a bone's) goes over to the small
// mesh, and back again to all places of the original.

#include <cmath>
#include <iostream>
#include <stdexcept>

#include "faqem/asset.hpp"
#include "faqem/forward_map.hpp"
#include "faqem/simplify.hpp"
#include "faqem/surface_map.hpp"

// The quantity at a place of a face, between its corners.
double mixed(const std::vector<double>& values, const faqem::Triangle& t, const faqem::Vec3& barycentric) {
    return barycentric[0] * values[t[0]] + barycentric[1] * values[t[1]] + barycentric[2] * values[t[2]];
}

int main(int argc, char** argv) try {
    if (argc != 2) throw std::invalid_argument("usage: field_transfer IN");
    const faqem::Asset model = faqem::load(argv[1]);
    const faqem::Part& original = model.parts.at(0);
    std::vector<double> temperature;  // per vertex of the original, from 0 to 1
    for (const faqem::Vec3& p : original.positions)
        temperature.push_back(0.5 + 0.5 * std::sin(2 * p[0] + p[1]));

    const auto small = faqem::simplify({original.positions, original.triangles},
                                       {.target = faqem::ratio(0.2), .history = faqem::Recording::on});

    // To the small mesh: where each of its vertices lies on the original.
    const faqem::SurfaceMap to_original(small.history, faqem::Mapping::projection);
    std::vector<double> cool(small.mesh.positions.size(), 0);
    for (faqem::Index f = 0; f < small.mesh.triangles.size(); ++f) {
        for (std::size_t k = 0; k < 3; ++k) {
            faqem::Vec3 corner = {};
            corner[k] = 1;
            const faqem::SurfacePoint at = to_original.map(f, corner);
            cool[small.mesh.triangles[f][k]] =
                mixed(temperature, original.triangles[at.face], at.barycentric);
        }
    }

    // And back: where each corner of the original lies on the small mesh.
    const faqem::ForwardMap to_small(small.history);
    double sum = 0;
    std::size_t count = 0, lost = 0;
    for (faqem::Index f = 0; f < original.triangles.size(); ++f) {
        const faqem::SimplifiedPoint at = to_small.map(f, {1, 0, 0});
        if (at.face == faqem::no_index && ++lost) continue;
        sum += std::abs(mixed(cool, small.mesh.triangles[at.face], at.barycentric) -
                        temperature[original.triangles[f][0]]);
        ++count;
    }
    std::cout << small.mesh.triangles.size() << " faces; the field there and back differs by "
              << sum / static_cast<double>(count) << " on average, " << lost << " places are lost\n";
    return sum < 0.02 * static_cast<double>(count) ? 0 : 1;
} catch (const std::exception& error) {
    std::cerr << "field_transfer: " << error.what() << "\n";
    return 1;
}
