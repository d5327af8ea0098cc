// Bake::automatic keeps the UVs of parts whose pictures are as good as with new images.

#include <cmath>

#include "faqem/bake.hpp"
#include "support/catch.hpp"
#include "support/scenes.hpp"

using namespace faqem;
using namespace faqem::test;

namespace {

// A smooth sheet whose texture is repeated `repeats` times in both directions.
Part tiled_sheet(Index n, float repeats) {
    Part part = sheet(n, [n](double x, double y) { return Vec3{x / n, y / n, 0.05 * std::sin(3 * x / n)}; });
    part.name = "sheet";
    part.uvs.resize(1);
    for (const Vec3& p : part.positions)
        part.uvs[0].push_back({repeats * static_cast<float>(p[0]), repeats * static_cast<float>(1 - p[1])});
    part.face_material.assign(part.triangles.size(), 0);
    return part;
}

// Stripes that differ at every texel.
Pixels weave(std::uint32_t size) {
    return paint(size, size, [](std::uint32_t x, std::uint32_t y) {
        return Rgba{static_cast<std::uint8_t>(40 + 37 * (x * x + 3 * y) % 180),
                    static_cast<std::uint8_t>(60 + 53 * (y * y + x) % 150), 90, 255};
    });
}

Asset tiled_cloth() {
    Asset asset = textured_square(weave(256));
    TextureRef& texture = asset.materials[0].base_color_texture;
    texture.wrap_u = texture.wrap_v = Wrap::repeat;
    asset.parts = {tiled_sheet(24, 40)};
    return asset;
}

// UVs by triangle at random places of the image: every edge is a seam.
Asset shuffled_sheet() {
    Asset asset = textured_square(weave(256));
    const Part from = tiled_sheet(16, 1);
    Part& part = asset.parts[0] = from;
    part.positions.clear();
    part.uvs[0].clear();
    for (std::size_t f = 0; f < from.triangles.size(); ++f) {
        for (std::size_t k = 0; k < 3; ++k) {
            const Index v = from.triangles[f][k];
            part.triangles[f][k] = static_cast<Index>(part.positions.size());
            part.positions.push_back(from.positions[v]);
            const Vec2f& uv = from.uvs[0][v];
            const auto shift = static_cast<float>(f * 7 % 11) / 16;
            part.uvs[0].push_back({uv[0] / 3 + shift, uv[1] / 3 + shift});
        }
    }
    return asset;
}

Options tenth() {
    Options options;
    options.target = ratio(0.1);
    options.bake.texture_size = 256;
    return options;
}

}  // namespace

TEST_CASE("kept UVs: a repeated pattern stays an image that is repeated") {
    const Asset asset = tiled_cloth();
    const SimplifiedAsset result = simplify(asset, tenth());
    CHECK(result.report.kept_uvs == std::vector<std::string>{"part 'sheet'"});
    CHECK(result.report.pages.empty());
    CHECK(result.report.faces_out <= result.report.target_faces);
    CHECK(result.report.faces_out == result.asset.parts[0].triangles.size());
    REQUIRE(result.asset.images.size() == 1);
    CHECK(result.asset.materials[0].base_color_texture.wrap_u == Wrap::repeat);
    float largest = 0;
    for (const Vec2f& uv : result.asset.parts[0].uvs[0]) largest = std::max(largest, uv[0]);
    CHECK(largest == Approx(40).epsilon(0.01));
}

TEST_CASE("kept UVs: a part whose UVs cannot follow the simplification gets a new page") {
    const SimplifiedAsset result = simplify(shuffled_sheet(), tenth());
    CHECK(result.report.kept_uvs.empty());
    CHECK(result.report.pages.size() == 1);
    CHECK(result.report.faces_out <= result.report.target_faces);
}

TEST_CASE("kept UVs: parts that share an image keep it together or not at all") {
    Asset asset = shuffled_sheet();
    asset.parts.push_back(tiled_sheet(24, 1));
    CHECK(simplify(asset, tenth()).report.kept_uvs.empty());
    asset.materials.push_back(asset.materials[0]);
    asset.materials[1].base_color_texture.image = add_texture(asset, ramp(128));
    for (Index& m : asset.parts[1].face_material) m = 1;
    const SimplifiedAsset result = simplify(asset, tenth());
    CHECK(result.report.kept_uvs == std::vector<std::string>{"part 'sheet'"});
    CHECK(result.report.pages.size() == 1);
    CHECK(result.asset.parts[0].triangles.size() + result.asset.parts[1].triangles.size() ==
          result.report.faces_out);
}

TEST_CASE("kept UVs: textures without filter stay whole, whatever the pictures") {
    Asset asset = textured_square(weave(64));
    asset.parts = {tiled_sheet(24, 1)};
    for (Vec2f& uv : asset.parts[0].uvs[0]) uv[0] = uv[0] * uv[0];  // does not survive the simplification well
    asset.materials[0].base_color_texture.filter = Filter::nearest;
    const SimplifiedAsset result = simplify(asset, tenth());
    CHECK(result.report.kept_uvs.size() == 1);
    CHECK(result.asset.materials[0].base_color_texture.filter == Filter::nearest);
    CHECK(decode(result.asset.images.at(0)).width == 64);
}

TEST_CASE("kept UVs: none are tried when an option is about the atlas or the collapses") {
    const Asset asset = tiled_cloth();
    const auto kept = [&](Options options) { return simplify_parts(asset, options).kept.size(); };
    CHECK(kept(tenth()) == 1);
    Options options = tenth();
    options.history = Recording::on;
    CHECK(kept(options) == 0);
    options = tenth();
    options.bake.correspondence = Recording::on;
    CHECK(kept(options) == 0);
    options = tenth();
    options.bake.kind = Bake::atlas;
    CHECK(kept(options) == 0);
    options = tenth();
    options.bake.texel_density = 1;
    CHECK(kept(options) == 0);
    options = tenth();
    options.bake.normal_map = NormalMap::on;
    CHECK(kept(options) == 0);
    options = tenth();
    options.target = ratio(1);
    CHECK(kept(options) == 0);
}

TEST_CASE("kept UVs: the result does not depend on the number of threads") {
    const Asset asset = tiled_cloth();
    Options options = tenth();
    options.threads = 1;
    const SimplifiedAsset one = simplify(asset, options);
    options.threads = 2;
    const SimplifiedAsset two = simplify(asset, options);
    CHECK(one.report.kept_uvs == two.report.kept_uvs);
    CHECK(one.asset.parts[0].positions == two.asset.parts[0].positions);
    CHECK(one.asset.parts[0].uvs == two.asset.parts[0].uvs);
    CHECK(one.asset.images[0].encoded == two.asset.images[0].encoded);
}

TEST_CASE("kept UVs: cancellation at any time gives a cancelled result") {
    const Asset asset = tiled_cloth();
    Options options = tenth();
    int calls = 0;
    options.progress = [&](Phase, double) {
        ++calls;
        return Continue::yes;
    };
    simplify(asset, options);
    const int all = calls;
    for (int limit = 1; limit < all; limit += std::max(1, all / 7)) {
        calls = 0;
        options.progress = [&](Phase, double) { return ++calls < limit ? Continue::yes : Continue::cancel; };
        const SimplifiedAsset result = simplify(asset, options);
        if (calls < limit) continue;  // the number of calls depends on the time
        CHECK(result.report.stop == StopReason::cancelled);
        CHECK(result.asset.parts.empty());
    }
}
