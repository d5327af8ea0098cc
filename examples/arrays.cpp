// Flat arrays, the standard library alone: a tile of terrain becomes light, while its border stays where it
// is, so that neighbouring tiles still fit, and more is kept around a place that matters.

#include <cmath>
#include <cstdlib>
#include <exception>
#include <iostream>

#include "faqem/simplify.hpp"

int main(int argc, char** argv) try {
    const std::uint32_t side = 200;  // samples per side, a metre apart
    std::vector<float> heights_as_positions;
    std::vector<std::uint8_t> locks;
    std::vector<float> weights;
    for (std::uint32_t y = 0; y < side; ++y) {
        for (std::uint32_t x = 0; x < side; ++x) {
            const float u = float(x), v = float(y);
            const float height =
                9 * std::sin(u / 23) * std::cos(v / 17) + 0.7f * std::sin(u / 3) * std::sin(v / 4);
            heights_as_positions.insert(heights_as_positions.end(), {u, v, height});
            locks.push_back(x == 0 || y == 0 || x == side - 1 || y == side - 1);
            weights.push_back(std::hypot(u - 60, v - 80) < 25 ? 30.0f : 1.0f);  // a path leads here
        }
    }
    std::vector<std::uint32_t> triangles;
    for (std::uint32_t y = 0; y + 1 < side; ++y) {
        for (std::uint32_t x = 0; x + 1 < side; ++x) {
            const std::uint32_t a = y * side + x, b = a + side;
            triangles.insert(triangles.end(), {a, a + 1, b + 1, a, b + 1, b});
        }
    }

    faqem::MeshView tile{heights_as_positions, triangles};
    tile.vertex_locks = locks;
    tile.vertex_weights = weights;
    const double share = argc > 1 ? std::atof(argv[1]) : 0.1;
    const auto out = faqem::simplify(tile, {.target = faqem::ratio(share)});

    std::size_t on_border = 0;
    for (const faqem::Index v : out.vertex_origin) on_border += locks[v];
    std::cout << out.report.faces_in << " faces, now " << out.report.faces_out << "; " << on_border
              << " vertices on the border; " << name(out.report.stop) << "\n";
    return on_border == std::size_t{4} * (side - 1) ? 0 : 1;
} catch (const std::exception& error) {
    std::cerr << "arrays: " << error.what() << "\n";
    return 1;
}
