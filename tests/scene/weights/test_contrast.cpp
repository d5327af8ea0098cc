// Factors by how much the components of a scene stand out.

#include "scene/weights/contrast.hpp"

#include <algorithm>

#include "scene/parts/simplify_parts.hpp"
#include "support/catch.hpp"
#include "support/scenes.hpp"

using namespace faqem;
using namespace faqem::test;

namespace {

constexpr double grey = 0.5;

// A sphere with two small ones on it, in one mesh. \param eyes  brightness of these; that of the large one is grey
Asset head(double eyes) {
    TriangleMesh mesh = icosphere(4);
    const std::size_t skin = mesh.triangles.size();
    for (const double side : {-0.4, 0.4})
        mesh = both(std::move(mesh), moved(scaled(icosphere(2), 0.15), {0.9, side, 0.2}));
    Asset asset = asset_with({part_of(mesh, 0)});
    asset.materials.resize(2);
    for (std::size_t m = 0; m < 2; ++m) {
        const auto brightness = static_cast<float>(m == 0 ? grey : eyes);
        asset.materials[m].base_color = {brightness, brightness, brightness, 1};
    }
    std::fill(asset.parts[0].face_material.begin() + static_cast<std::ptrdiff_t>(skin),
              asset.parts[0].face_material.end(), 1);
    return asset;
}

// Number of faces of the eyes at 5%.
std::size_t faces_of_eyes(double brightness) {
    const Asset source = head(brightness);
    const SimplifiedParts result = simplify_parts(source, {.target = ratio(0.05)});
    return static_cast<std::size_t>(std::ranges::count_if(
        result.parts[0].face_origin, [&](Index f) { return source.parts[0].face_material[f] == 1; }));
}

}  // namespace

TEST_CASE("contrast: small components of another colour have larger factors") {
    const Asset source = head(0);
    const auto weights = detail::contrast_weights(source, {});
    REQUIRE(weights.size() == 1);
    REQUIRE(weights[0].size() == source.parts[0].positions.size());
    const std::size_t skin = icosphere(4).positions.size();
    for (std::size_t v = 0; v < weights[0].size(); ++v)
        CHECK((v < skin ? weights[0][v] == 1 : weights[0][v] > 2 && weights[0][v] <= 10));
    CHECK(faces_of_eyes(0) > 3 * faces_of_eyes(grey) / 2);
}

TEST_CASE("contrast: components of one colour, hidden ones and single ones have none") {
    CHECK(detail::contrast_weights(head(grey), {})[0].empty());
    CHECK(detail::contrast_weights(asset_with({part_of(icosphere(2), 0)}), {})[0].empty());
    Asset inside = head(0);
    for (std::size_t v = icosphere(4).positions.size(); v < inside.parts[0].positions.size(); ++v)
        inside.parts[0].positions[v][0] -= 0.9;
    CHECK(detail::contrast_weights(inside, {})[0].empty());
}
