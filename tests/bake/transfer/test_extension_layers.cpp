// Textures of material extensions: clear coat, sheen and the like.

#include "bake/transfer/extension_layers.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "support/lit.hpp"

using namespace faqem;
using namespace faqem::test;
using detail::ExtensionLayer;
using detail::TextureContent;

namespace {

TextureRef use_of(Index image) {
    TextureRef use;
    use.image = image;
    use.wrap_u = use.wrap_v = Wrap::clamp;
    return use;
}

// Channels that each go another way, alpha too.
Pixels four_ramps() {
    return paint(32, 32, [](std::uint32_t x, std::uint32_t y) {
        return Rgba{static_cast<std::uint8_t>(40 + 6 * x), static_cast<std::uint8_t>(40 + 6 * y),
                    static_cast<std::uint8_t>(230 - 6 * x), static_cast<std::uint8_t>(230 - 6 * y)};
    });
}

Asset square_with(std::vector<ExtensionTexture> textures, const Pixels& pixels) {
    Asset asset;
    asset.parts = {square()};
    asset.parts[0].normals.assign(4, {0, 0, 1});
    asset.materials.resize(1);
    asset.materials[0].name = "cloth";
    add_texture(asset, pixels);
    asset.materials[0].extension_textures = std::move(textures);
    return asset;
}

Options look_of(Bake kind = Bake::atlas) {
    Options options;
    options.bake.kind = kind;
    options.bake.texture_size = 256;
    return options;
}

const ExtensionTexture& texture_of(const SimplifiedAsset& light, const std::string& name) {
    for (const ExtensionTexture& texture : light.asset.materials.at(0).extension_textures)
        if (texture.name == name) return texture;
    FAIL(name);
    throw 0;
}

Pixels pixels_of(const SimplifiedAsset& light, const std::string& name) {
    return decode(light.asset.images[texture_of(light, name).texture.image]);
}

// The largest difference over the square, of those channels.
double worst(const Asset& source, const Pixels& painted, const SimplifiedAsset& light, const Pixels& baked,
             std::vector<std::size_t> channels) {
    double result = 0;
    for (std::size_t f = 0; f < 2; ++f) {
        for (const Vec3& w : spread(12)) {
            const auto before = look(source.parts[0], painted, f, w),
                       after = look(light.asset.parts[0], baked, f, w);
            for (const std::size_t k : channels) result = std::max(result, std::abs(before[k] - after[k]));
        }
    }
    return result;
}

}  // namespace

TEST_CASE("colour and alpha of one image share a layer, numbers and normals have their own") {
    Material material;
    material.extension_textures = {{"KHR_materials_clearcoat", "clearcoatNormalTexture", use_of(0)},
                                   {"KHR_materials_clearcoat", "clearcoatRoughnessTexture", use_of(0)},
                                   {"KHR_materials_clearcoat", "clearcoatTexture", use_of(0)},
                                   {"KHR_materials_sheen", "sheenColorTexture", use_of(0)},
                                   {"KHR_materials_sheen", "sheenRoughnessTexture", use_of(0)},
                                   {"KHR_materials_specular", "specularTexture", use_of(1)},
                                   {"VENDOR_teapot", "lidTexture", use_of(0)},
                                   {"KHR_materials_transmission", "transmissionTexture", {}}};
    material.extension_textures[0].normal_scale = 0.5f;
    const std::vector<ExtensionLayer> layers = detail::extension_layers(material);
    REQUIRE(layers.size() == 4);
    CHECK(layers[0].content == TextureContent::normal);
    CHECK(layers[0].normal_scale == 0.5f);
    CHECK(layers[1].content == TextureContent::data);
    CHECK(layers[1].textures == std::vector<Index>{1, 2});
    CHECK(layers[2].content == TextureContent::color_and_alpha);
    CHECK(layers[2].textures == std::vector<Index>{3, 4});
    CHECK(layers[3].content == TextureContent::alpha);

    material.extension_textures[4].texture.offset = {0.5f, 0};
    CHECK(detail::extension_layers(material).size() == 5);
}

TEST_CASE("tangents are those of the normal map, else of a coat's") {
    Material material;
    CHECK(detail::tangent_texture(material) == nullptr);
    material.extension_textures = {{"KHR_materials_clearcoat", "clearcoatTexture", use_of(0)},
                                   {"KHR_materials_clearcoat", "clearcoatNormalTexture", use_of(1)}};
    CHECK(detail::tangent_texture(material) == &material.extension_textures[1].texture);
    material.normal_texture = use_of(2);
    CHECK(detail::tangent_texture(material) == &material.normal_texture);
}

TEST_CASE("a sheen's colour and roughness are baked into one image with alpha") {
    const Pixels ramps = four_ramps();
    const Asset source = square_with({{"KHR_materials_sheen", "sheenColorTexture", use_of(0)},
                                      {"KHR_materials_sheen", "sheenRoughnessTexture", use_of(0)}},
                                     ramps);
    const Bake kind = GENERATE(Bake::atlas, Bake::per_triangle);
    const SimplifiedAsset light = bake(source, unchanged(source), look_of(kind));
    CHECK(texture_of(light, "sheenColorTexture").texture ==
          texture_of(light, "sheenRoughnessTexture").texture);
    CHECK(light.asset.images.size() == 1);
    CHECK(light.asset.images[0].name == "cloth_sheenColor");
    CHECK(worst(source, ramps, light, pixels_of(light, "sheenColorTexture"), {0, 1, 2, 3}) < 4);
}

TEST_CASE("numbers are read as they are, and an image for alpha alone has no colour") {
    const Pixels ramps = four_ramps();
    const Asset source = square_with({{"KHR_materials_clearcoat", "clearcoatRoughnessTexture", use_of(0)},
                                      {"KHR_materials_specular", "specularTexture", use_of(0)}},
                                     ramps);
    const SimplifiedAsset light = bake(source, unchanged(source), look_of());
    const Pixels roughness = pixels_of(light, "clearcoatRoughnessTexture");
    CHECK(worst(source, ramps, light, roughness, {0, 1, 2}) < 4);
    CHECK_FALSE(roughness.has_alpha);
    const Pixels specular = pixels_of(light, "specularTexture");
    CHECK(worst(source, ramps, light, specular, {3}) < 4);
    CHECK(specular.rgba[0] == 255);
}

TEST_CASE("colours are averaged in linear light, alpha as it is") {
    // Columns of black and white, one texel each, a hundred to a texel of the page.
    const Pixels stripes = paint(128, 128, [](std::uint32_t x, std::uint32_t) {
        const std::uint8_t shade = x % 2 ? 255 : 0;
        return Rgba{shade, shade, shade, shade};
    });
    const Asset source = square_with({{"KHR_materials_specular", "specularColorTexture", use_of(0)},
                                      {"KHR_materials_specular", "specularTexture", use_of(0)}},
                                     stripes);
    Options options = look_of();
    options.bake.texel_density = 0.125;
    options.bake.texture_size = 64;
    const SimplifiedAsset light = bake(source, unchanged(source), options);
    const auto middle = look(light.asset.parts[0], pixels_of(light, "specularTexture"), 0, {0.4, 0.3, 0.3});
    CHECK(std::abs(middle[0] - 188) < 3);  // of light
    CHECK(std::abs(middle[3] - 128) < 3);
}

TEST_CASE("a coat's normals light the result as they lit the source, its scale included") {
    // (0.6, 0.48, 0.64) in tangent space; half of it to the side.
    const Pixels leaning = paint(8, 8, [](std::uint32_t, std::uint32_t) { return Rgba{204, 189, 209, 255}; });
    Asset source =
        square_with({{"KHR_materials_clearcoat", "clearcoatNormalTexture", use_of(0), 0.5f}}, leaning);
    for (Vec2f& uv : source.parts[0].uvs[0]) uv[0] = 1 - uv[0];
    const SimplifiedAsset light = bake(source, unchanged(source), look_of());
    CHECK(texture_of(light, "clearcoatNormalTexture").normal_scale == 1);
    CHECK_FALSE(light.asset.materials[0].normal_texture);
    const Part& part = light.asset.parts[0];
    REQUIRE(part.tangents.size() == part.positions.size());
    const Pixels map = pixels_of(light, "clearcoatNormalTexture");
    for (std::size_t f = 0; f < 2; ++f) {
        for (const Vec3& w : spread(6))
            CHECK(degrees_between(lit_normal(part, map, f, w), unit({-0.3, 0.24, 0.64})) < 1);
    }

    Options plain = look_of();
    plain.bake.normal_map = NormalMap::off;
    const SimplifiedAsset without = bake(source, unchanged(source), plain);
    CHECK(without.asset.materials[0].extension_textures.empty());
    CHECK(without.asset.parts[0].tangents.empty());
}

TEST_CASE("what lies beside a coat, of another material, does not run into it") {
    // The left square is coated all over (white), the right one is not at all.
    const Pixels white = paint(8, 8, [](std::uint32_t, std::uint32_t) { return Rgba{250, 250, 250, 255}; });
    Asset source = square_with({{"KHR_materials_clearcoat", "clearcoatTexture", use_of(0)}}, white);
    source.materials.emplace_back();
    source.parts[0].face_material = {0, 1};
    const SimplifiedAsset light = bake(source, unchanged(source), look_of());
    const Pixels coat = pixels_of(light, "clearcoatTexture");
    const auto [least, most] = std::minmax_element(coat.rgba.begin(), coat.rgba.end());
    CHECK(*least >= 249);
    CHECK(light.asset.materials[1].extension_textures.empty());
}

TEST_CASE("vertices and bare geometry have no textures of extensions") {
    const Asset source =
        square_with({{"KHR_materials_clearcoat", "clearcoatTexture", use_of(0)}}, four_ramps());
    for (const Bake kind : {Bake::vertex, Bake::none}) {
        const SimplifiedAsset light = bake(source, unchanged(source), look_of(kind));
        CHECK(light.asset.materials[0].extension_textures.empty());
        CHECK(light.asset.images.empty());
    }
}
