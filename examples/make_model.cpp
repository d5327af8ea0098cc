// Generates the model of the quick start: a carved and painted urn with a boundary at its rim, twisted
// handles and thin leaves, in many UV charts. The result is the same on every run.

#include <charconv>
#include <cmath>
#include <cstring>
#include <exception>
#include <iostream>

#include "faqem/asset.hpp"
#include "model_parts.hpp"

namespace {

constexpr std::uint32_t texture_size = 2048;
constexpr std::uint64_t default_faces = 220'000, max_faces = 20'000'000;

std::vector<model::Grid> grids(double detail) {
    std::vector<model::Grid> all = model::ornaments(detail);
    all.insert(all.begin(), model::body(detail));
    return all;
}

/// Number of faces of all grids: two per cell, except at the poles.
std::uint64_t face_count(const std::vector<model::Grid>& all) {
    std::uint64_t faces = 0;
    for (const model::Grid& grid : all) {
        faces += 2 * static_cast<std::uint64_t>(grid.columns) * static_cast<std::uint64_t>(grid.rows - 1);
    }
    return faces;
}

int usage() {
    std::cerr
        << "usage: make_model OUT.glb [--faces N]   (at least N faces, 1000 to 20000000; default 220000)\n";
    return 2;
}

}  // namespace

int main(int argc, char** argv) try {
    std::uint64_t wanted = default_faces;
    if (argc == 4 && std::strcmp(argv[2], "--faces") == 0) {
        const char* end = argv[3] + std::strlen(argv[3]);
        const auto [stop, error] = std::from_chars(argv[3], end, wanted);
        if (error != std::errc{} || stop != end || wanted < 1000 || wanted > max_faces) return usage();
    } else if (argc != 2) {
        return usage();
    }
    double detail = std::sqrt(static_cast<double>(wanted) / 290'000.0);
    while (face_count(grids(detail)) < wanted) detail *= 1.002;

    const faqem::Asset urn = model::build(grids(detail), "urn", texture_size);
    for (const std::string& warning : faqem::save(urn, argv[1], faqem::Overwrite::yes)) {
        std::cerr << "warning: " << warning << "\n";
    }
    std::cout << argv[1] << ": " << urn.parts[0].triangles.size() << " faces\n";
    return 0;
} catch (const std::exception& error) {
    std::cerr << "make_model: " << error.what() << "\n";
    return 1;
}
