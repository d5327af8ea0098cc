#include "faqem/detail/mapping/surface_patches.hpp"

#include <cmath>

#include "support/catch.hpp"

using namespace faqem;
using detail::find_surface_patches;
using detail::SurfacePatches;

namespace {

// Triangles around the edge from (0, 0, 0) to (0, 0, 1), each at an angle in degrees.
SurfacePatches around_an_edge(const std::vector<double>& angles, std::span<const Triangle> unwelded = {}) {
    std::vector<Vec3> positions = {{0, 0, 0}, {0, 0, 1}};
    std::vector<Triangle> triangles;
    for (const double angle : angles) {
        triangles.push_back({0, 1, static_cast<Index>(positions.size())});
        const double a = angle * std::acos(-1.0) / 180;
        positions.push_back({std::cos(a), std::sin(a), 0.3});
    }
    return find_surface_patches(positions, triangles, unwelded);
}

}  // namespace

TEST_CASE("surface patches: two faces on an edge are one patch at any angle") {
    CHECK(around_an_edge({0, 180}).surface_patch == std::vector<Index>{0, 0});
    CHECK(around_an_edge({0, 5}).surface_patch == std::vector<Index>{0, 0});
}

TEST_CASE("surface patches: a fin does not divide a surface, and crossing surfaces are two patches") {
    CHECK(around_an_edge({0, 90, 180}).surface_patch == std::vector<Index>{0, 1, 0});
    CHECK(around_an_edge({0, 70, 165}).surface_patch == std::vector<Index>{0, 1, 0});
    CHECK(around_an_edge({0, 90, 180, 270}).surface_patch == std::vector<Index>{0, 1, 0, 1});
}

TEST_CASE("surface patches: if the continuation is ambiguous, all faces are separate patches") {
    CHECK(around_an_edge({0, 3, 180}).surface_patch ==
          std::vector<Index>{0, 1, 2});  // a thin wall that ends in a fin
    CHECK(around_an_edge({0, 120, 240}).surface_patch == std::vector<Index>{0, 1, 2});
    CHECK(around_an_edge({0, 0, 180, 180}).surface_patch == std::vector<Index>{0, 1, 2, 3});
}

TEST_CASE("surface patches: faces that were the only two on an edge before welding are one patch") {
    const std::vector<Triangle> unwelded = {{0, 1, 2}, {3, 4, 5}, {0, 1, 6}, {3, 4, 7}};
    CHECK(around_an_edge({0, 0, 180, 180}, unwelded).surface_patch == std::vector<Index>{0, 1, 0, 1});
    CHECK(around_an_edge({0, 180, 90, 270}, unwelded).surface_patch == std::vector<Index>{0, 1, 0, 1});
}

TEST_CASE("surface patches: faces and relative orientations of each patch") {
    // All half-edges on the edge have the same direction, so that the two faces of patch 0 have opposite
    // orientations.
    const SurfacePatches patches = around_an_edge({0, 90, 180});
    const auto faces_of = [&](Index patch) {
        return std::vector<Index>(patches.faces[patch].begin(), patches.faces[patch].end());
    };
    CHECK(patches.surface_patch == std::vector<Index>{0, 1, 0});
    CHECK(faces_of(0) == std::vector<Index>{0, 2});
    CHECK(faces_of(1) == std::vector<Index>{1});
    CHECK(patches.sign[0] == -patches.sign[2]);
    CHECK(patches.sign[1] == 1);
}
