// Textures of material extensions: clear coat, sheen and the like.

#include "bake/source/extension_layers.hpp"

#include <algorithm>
#include <cmath>

#include "support/catch.hpp"
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

// A ramp in a different direction in every channel, including alpha.
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

Options options_for(Bake kind = Bake::atlas) {
    Options options = lossless();
    options.bake.kind = kind;
    options.bake.texture_size = 256;
    return options;
}

const ExtensionTexture& texture_of(const SimplifiedAsset& simplified, const std::string& name) {
    for (const ExtensionTexture& texture : simplified.asset.materials.at(0).extension_textures)
        if (texture.name == name) return texture;
    FAIL(name);
    throw 0;
}

Pixels pixels_of(const SimplifiedAsset& simplified, const std::string& name) {
    return decode(simplified.asset.images[texture_of(simplified, name).texture.image]);
}

// The largest difference of the given channels over the square.
double worst(const Asset& source, const Pixels& painted, const SimplifiedAsset& simplified,
             const Pixels& baked, std::vector<std::size_t> channels) {
    double result = 0;
    for (std::size_t f = 0; f < 2; ++f) {
        for (const Vec3& w : spread(12)) {
            const auto before = look(source.parts[0], painted, f, w),
                       after = look(simplified.asset.parts[0], baked, f, w);
            for (const std::size_t k : channels) result = std::max(result, std::abs(before[k] - after[k]));
        }
    }
    return result;
}

}  // namespace

TEST_CASE("colour and alpha of an image share a layer and data and normals have their own") {
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

TEST_CASE("tangents are for the normal map or else for a clear coat normal map") {
    Material material;
    CHECK(detail::tangent_texture(material) == nullptr);
    material.extension_textures = {{"KHR_materials_clearcoat", "clearcoatTexture", use_of(0)},
                                   {"KHR_materials_clearcoat", "clearcoatNormalTexture", use_of(1)}};
    CHECK(detail::tangent_texture(material) == &material.extension_textures[1].texture);
    material.normal_texture = use_of(2);
    CHECK(detail::tangent_texture(material) == &material.normal_texture);
}

TEST_CASE("sheen colour and roughness are baked into one image with alpha") {
    const Pixels ramps = four_ramps();
    const Asset source = square_with({{"KHR_materials_sheen", "sheenColorTexture", use_of(0)},
                                      {"KHR_materials_sheen", "sheenRoughnessTexture", use_of(0)}},
                                     ramps);
    const Bake kind = GENERATE(Bake::atlas, Bake::per_triangle);
    const SimplifiedAsset simplified = bake(source, unchanged(source), options_for(kind));
    CHECK(texture_of(simplified, "sheenColorTexture").texture ==
          texture_of(simplified, "sheenRoughnessTexture").texture);
    CHECK(simplified.asset.images.size() == 1);
    CHECK(simplified.asset.images[0].name == "cloth_sheenColor");
    CHECK(worst(source, ramps, simplified, pixels_of(simplified, "sheenColorTexture"), {0, 1, 2, 3}) < 4);
}

TEST_CASE("data textures are not converted and alpha-only images are white") {
    const Pixels ramps = four_ramps();
    const Asset source = square_with({{"KHR_materials_clearcoat", "clearcoatRoughnessTexture", use_of(0)},
                                      {"KHR_materials_specular", "specularTexture", use_of(0)}},
                                     ramps);
    const SimplifiedAsset simplified = bake(source, unchanged(source), options_for());
    const Pixels roughness = pixels_of(simplified, "clearcoatRoughnessTexture");
    CHECK(worst(source, ramps, simplified, roughness, {0, 1, 2}) < 4);
    CHECK_FALSE(roughness.has_alpha);
    const Pixels specular = pixels_of(simplified, "specularTexture");
    CHECK(worst(source, ramps, simplified, specular, {3}) < 4);
    CHECK(specular.rgba[0] == 255);
}

TEST_CASE("colours are averaged in linear light and alpha without conversion") {
    // Black and white columns of one texel, of which a texel of the page covers many.
    const Pixels stripes = paint(128, 128, [](std::uint32_t x, std::uint32_t) {
        const std::uint8_t shade = x % 2 ? 255 : 0;
        return Rgba{shade, shade, shade, shade};
    });
    const Asset source = square_with({{"KHR_materials_specular", "specularColorTexture", use_of(0)},
                                      {"KHR_materials_specular", "specularTexture", use_of(0)}},
                                     stripes);
    Options options = options_for();
    options.bake.texel_density = 0.125;
    options.bake.texture_size = 64;
    const SimplifiedAsset simplified = bake(source, unchanged(source), options);
    const auto middle =
        look(simplified.asset.parts[0], pixels_of(simplified, "specularTexture"), 0, {0.4, 0.3, 0.3});
    CHECK(std::abs(middle[0] - 188) < 3);  // sRGB 188 is a linear value of 0.5
    CHECK(std::abs(middle[3] - 128) < 3);
}

TEST_CASE("baking preserves the shading of a clear coat normal map and its scale") {
    // (0.6, 0.48, 0.64) in tangent space; normal_scale halves x and y.
    const Pixels leaning = paint(8, 8, [](std::uint32_t, std::uint32_t) { return Rgba{204, 189, 209, 255}; });
    Asset source =
        square_with({{"KHR_materials_clearcoat", "clearcoatNormalTexture", use_of(0), 0.5f}}, leaning);
    for (Vec2f& uv : source.parts[0].uvs[0]) uv[0] = 1 - uv[0];
    const SimplifiedAsset simplified = bake(source, unchanged(source), options_for());
    CHECK(texture_of(simplified, "clearcoatNormalTexture").normal_scale == 1);
    CHECK_FALSE(simplified.asset.materials[0].normal_texture);
    const Part& part = simplified.asset.parts[0];
    REQUIRE(part.tangents.size() == part.positions.size());
    const Pixels map = pixels_of(simplified, "clearcoatNormalTexture");
    for (std::size_t f = 0; f < 2; ++f) {
        for (const Vec3& w : spread(6))
            CHECK(degrees_between(lit_normal(part, map, f, w), unit({-0.3, 0.24, 0.64})) < 1);
    }

    Options plain = options_for();
    plain.bake.normal_map = NormalMap::off;
    const SimplifiedAsset without = bake(source, unchanged(source), plain);
    CHECK(without.asset.materials[0].extension_textures.empty());
    CHECK(without.asset.parts[0].tangents.empty());
}

TEST_CASE("extension layers are not affected by adjacent faces of another material") {
    // The first triangle has a clear coat with a white texture, the second one another material without it.
    const Pixels white = paint(8, 8, [](std::uint32_t, std::uint32_t) { return Rgba{250, 250, 250, 255}; });
    Asset source = square_with({{"KHR_materials_clearcoat", "clearcoatTexture", use_of(0)}}, white);
    source.materials.emplace_back();
    source.parts[0].face_material = {0, 1};
    const SimplifiedAsset simplified = bake(source, unchanged(source), options_for());
    const Pixels coat = pixels_of(simplified, "clearcoatTexture");
    const auto [least, most] = std::minmax_element(coat.rgba.begin(), coat.rgba.end());
    CHECK(*least >= 249);
    CHECK(simplified.asset.materials[1].extension_textures.empty());
}

TEST_CASE("vertex and none remove extension textures") {
    const Asset source =
        square_with({{"KHR_materials_clearcoat", "clearcoatTexture", use_of(0)}}, four_ramps());
    for (const Bake kind : {Bake::vertex, Bake::none}) {
        const SimplifiedAsset simplified = bake(source, unchanged(source), options_for(kind));
        CHECK(simplified.asset.materials[0].extension_textures.empty());
        CHECK(simplified.asset.images.empty());
    }
}
