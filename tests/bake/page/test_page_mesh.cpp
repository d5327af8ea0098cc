#include <algorithm>

#include "support/catch.hpp"
#include "support/scenes.hpp"

using namespace faqem;
using namespace faqem::test;

namespace {

constexpr Index strips = 8;

// A flat square with strips of equal width in two plain materials, red and green.
Asset striped_square() {
    Asset asset;
    asset.materials.resize(2);
    asset.materials[0].base_color = {1, 0, 0, 1};
    asset.materials[1].base_color = {0, 1, 0, 1};
    Part part = sheet(strips, [](double x, double y) { return Vec3{x / strips, y / strips, 0}; });
    for (const Triangle& t : part.triangles) {
        const double x = (part.positions[t[0]][0] + part.positions[t[1]][0] + part.positions[t[2]][0]) / 3;
        part.face_material.push_back(static_cast<Index>(x * strips) % 2);
    }
    asset.parts = {std::move(part)};
    return asset;
}

}  // namespace

TEST_CASE("pages: of strips on a small page, nine tenths keep their own colour") {
    const Asset asset = striped_square();
    Options options = lossless();
    options.bake.kind = Bake::atlas;
    const Asset baked = bake(asset, unchanged(asset), options).asset;
    REQUIRE(baked.images.size() == 1);
    const Pixels page = decode(baked.images[0]);
    const Part& part = baked.parts[0];
    // With four times five texels across a strip, each of the 7 borders is seen in two of 160 texels: 8.75%.
    double points = 0, mixed = 0;
    for (const Triangle& t : part.triangles) {
        for (int i = 0; i < 30; ++i) {
            for (int j = 0; i + j < 30; ++j) {
                const double a = (i + 1.0 / 3) / 30, b = (j + 1.0 / 3) / 30, c = 1 - a - b;
                const auto at = [&](std::size_t k) {
                    return a * part.uvs[0][t[0]][k] + b * part.uvs[0][t[1]][k] + c * part.uvs[0][t[2]][k];
                };
                const auto color = read(page, at(0), at(1));
                ++points;
                if (std::min(color[0], color[1]) > 16) ++mixed;
            }
        }
    }
    CHECK(mixed / points < 0.1);
}
