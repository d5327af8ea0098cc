// Simplification of flat arrays: a terrain tile whose boundary vertices are locked, so that neighbouring
// tiles still match, and whose vertex weights preserve more detail around a point of interest.

#include <cmath>
#include <cstdlib>
#include <exception>
#include <iostream>

#include "faqem/simplify.hpp"

int main(int argc, char** argv) try {
    const std::uint32_t side = 200;  // samples per side, one metre apart
    std::vector<float> positions;
    std::vector<std::uint8_t> locks;
    std::vector<float> weights;
    for (std::uint32_t y = 0; y < side; ++y) {
        for (std::uint32_t x = 0; x < side; ++x) {
            const float u = float(x), v = float(y);
            const float height =
                9 * std::sin(u / 23) * std::cos(v / 17) + 0.7f * std::sin(u / 3) * std::sin(v / 4);
            positions.insert(positions.end(), {u, v, height});
            locks.push_back(x == 0 || y == 0 || x == side - 1 || y == side - 1);
            weights.push_back(std::hypot(u - 60, v - 80) < 25 ? 30.0f : 1.0f);  // point of interest
        }
    }
    std::vector<std::uint32_t> triangles;
    for (std::uint32_t y = 0; y + 1 < side; ++y) {
        for (std::uint32_t x = 0; x + 1 < side; ++x) {
            const std::uint32_t a = y * side + x, b = a + side;
            triangles.insert(triangles.end(), {a, a + 1, b + 1, a, b + 1, b});
        }
    }

    faqem::MeshView tile{positions, triangles};
    tile.vertex_locks = locks;
    tile.vertex_weights = weights;
    const double share = argc > 1 ? std::atof(argv[1]) : 0.1;
    const auto out = faqem::simplify(tile, {.target = faqem::ratio(share)});

    std::size_t on_boundary = 0;
    for (const faqem::Index v : out.vertex_origin) on_boundary += locks[v];
    std::cout << out.report.faces_in << " faces, now " << out.report.faces_out << "; " << on_boundary
              << " vertices on the boundary; " << name(out.report.stop) << "\n";
    return on_boundary == std::size_t{4} * (side - 1) ? 0 : 1;
} catch (const std::exception& error) {
    std::cerr << "arrays: " << error.what() << "\n";
    return 1;
}
