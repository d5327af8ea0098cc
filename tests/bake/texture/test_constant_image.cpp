#include "bake/texture/page_material.hpp"

#include "asset/scene/material_textures.hpp"
#include "support/catch.hpp"
#include "support/scenes.hpp"

using namespace faqem;
using namespace faqem::test;

namespace {

Pixels plain(Rgba color, std::uint32_t size = 4) {
    return paint(size, size, [&](std::uint32_t, std::uint32_t) { return color; });
}

Index add_plain(Asset& asset, Rgba color) { return add_texture(asset, plain(color)); }

}  // namespace

TEST_CASE("channels are constant if their known texels differ by at most 1") {
    Pixels pixels = plain({10, 20, 30, 255}, 2);
    pixels.rgba[0] = 200;  // not known
    pixels.rgba[4] = 11;
    pixels.rgba[9] = 22;
    const std::vector<std::uint8_t> known = {0, 1, 1, 1};
    const auto values = detail::constant_channels(pixels, known);
    CHECK(values[0] == 10.5f);
    CHECK_FALSE(values[1]);
    CHECK(values[2] == 30.0f);
    CHECK(values[3] == 255.0f);
    CHECK_FALSE(detail::constant_channels(pixels, std::vector<std::uint8_t>(4, 0))[2]);
}

TEST_CASE("images with one value become factors, and UVs without images are left out") {
    Asset asset = textured_square(plain({188, 0, 255, 255}));
    Material& material = asset.materials[0];
    material.metallic = 1;
    material.metallic_roughness_texture.image = add_plain(asset, {0, 51, 204, 255});
    material.occlusion_texture.image = add_plain(asset, {255, 255, 255, 255});
    material.emissive = {1, 1, 1};
    material.emissive_texture.image = add_plain(asset, {0, 188, 0, 255});
    material.normal_texture.image = add_plain(asset, {128, 127, 255, 255});
    const Options options{.target = ratio(1), .bake = {.kind = Bake::atlas}};
    const SimplifiedAsset simplified = bake(asset, unchanged(asset), options);
    CHECK(simplified.asset.images.empty());
    const Material& made = simplified.asset.materials.at(0);
    CHECK_FALSE(detail::has_textures(made));
    CHECK(made.base_color[0] == Approx(0.5).margin(0.005));  // sRGB 188
    CHECK(made.base_color[1] == 0);
    CHECK(made.base_color[2] == 1);
    CHECK(made.base_color[3] == 1);
    CHECK(made.roughness == Approx(0.2));
    CHECK(made.metallic == Approx(0.8));
    CHECK(made.emissive[1] == Approx(0.5).margin(0.005));
    CHECK(simplified.asset.parts.at(0).uvs.empty());
    CHECK(simplified.asset.parts.at(0).tangents.empty());
}

TEST_CASE("constant metal and roughness are factors beside a varying occlusion map") {
    Asset asset = textured_square(plain({255, 255, 255, 255}));
    Material& material = asset.materials[0];
    material.metallic = 1;
    material.occlusion_texture.image = add_texture(asset, ramp(16));
    material.metallic_roughness_texture.image = add_plain(asset, {0, 51, 204, 255});
    const Options options{.target = ratio(1), .bake = {.kind = Bake::atlas}};
    const SimplifiedAsset simplified = bake(asset, unchanged(asset), options);
    const Material& made = simplified.asset.materials.at(0);
    CHECK(simplified.asset.images.size() == 1);
    CHECK(made.occlusion_texture);
    CHECK_FALSE(made.metallic_roughness_texture);
    CHECK(made.roughness == Approx(0.2));
    CHECK(made.metallic == Approx(0.8));
    CHECK(simplified.asset.parts.at(0).uvs.size() == 1);
}

TEST_CASE("UVs of constant pages are kept for a correspondence") {
    const Asset asset = textured_square(plain({188, 0, 255, 255}));
    const Options options{.target = ratio(1), .bake = {.kind = Bake::atlas, .correspondence = Recording::on}};
    const SimplifiedAsset simplified = bake(asset, unchanged(asset), options);
    CHECK(simplified.asset.images.empty());
    CHECK(simplified.correspondence.size() == 1);
    CHECK(simplified.asset.parts.at(0).uvs.size() == 1);
}
