// Normals of the result's own faces, encodings, and what is told of a page.
#include <catch2/catch.hpp>
#include <cstring>
#include <sstream>

#include "faqem/error.hpp"
#include "support/scenes.hpp"

using namespace faqem;
using namespace faqem::test;

namespace {

const Vec3f up = {0, 0, 1};

// A roof: two squares that meet at an angle of 60 degrees between their normals, with wrong normals.
Asset roof() {
    Asset asset;
    asset.parts.resize(1);
    Part& part = asset.parts[0];
    const double h = std::sqrt(3.0) / 2;
    part.positions = {{0, 0, 0}, {0, 1, 0}, {-h, 0, -0.5}, {-h, 1, -0.5}, {h, 0, -0.5}, {h, 1, -0.5}};
    part.triangles = {{0, 1, 3}, {0, 3, 2}, {0, 4, 5}, {0, 5, 1}};
    part.normals.assign(6, {0.6f, 0, 0.8f});
    return asset;
}

Part normals_of(Normals kind, double angle) {
    const Asset asset = roof();
    Options options;
    options.bake.kind = Bake::none;
    options.bake.normals = kind;
    options.bake.crease_angle = angle;
    return bake(asset, unchanged(asset), options).asset.parts[0];
}

Options encoded_as(ImageFormat format) {
    Options options;
    options.bake.image_format = format;
    return options;
}

const Image& base_image(const SimplifiedAsset& light) {
    return light.asset.images[light.asset.materials[0].base_color_texture.image];
}

}  // namespace

TEST_CASE("smooth normals are those of the small mesh, averaged up to the angle") {
    const Part sharp = normals_of(Normals::smooth, 50), smooth = normals_of(Normals::smooth, 70);
    CHECK(sharp.positions.size() == 8);
    REQUIRE(smooth.positions.size() == 6);
    for (std::size_t v = 0; v < 6; ++v) {
        if (smooth.positions[v][0] != 0) continue;
        for (std::size_t k = 0; k < 3; ++k) CHECK(smooth.normals[v][k] == Approx(up[k]).margin(1e-6));
    }
}

TEST_CASE("flat normals are those of the faces, at any angle") {
    const Part part = normals_of(Normals::flat, 180);
    CHECK(part.positions.size() == 8);
    for (const Vec3f& n : part.normals) {
        CHECK(std::abs(n[0]) == Approx(0.5));
        CHECK(n[2] == Approx(std::sqrt(3.0) / 2));
    }
}

TEST_CASE("normals can be left out where nothing is baked, and no vertex is split then") {
    const Part part = normals_of(Normals::none, 40);
    CHECK(part.normals.empty());
    CHECK(part.positions.size() == 6);
    Options options;
    options.bake.normals = Normals::none;
    CHECK_THROWS_AS(bake(roof(), unchanged(roof()), options), OptionError);
}

TEST_CASE("baked images are PNG, JPEG, or as what they are baked from") {
    Asset asset = textured_square(ramp(64));
    CHECK(base_image(bake(asset, unchanged(asset), {})).mime_type == "image/png");
    const SimplifiedAsset jpeg = bake(asset, unchanged(asset), encoded_as(ImageFormat::jpeg));
    CHECK(base_image(jpeg).mime_type == "image/jpeg");
    const auto c = look(jpeg.asset.parts[0], decode(base_image(jpeg)), 0, {0.3, 0.3, 0.4});
    const auto painted = look(asset.parts[0], ramp(64), 0, {0.3, 0.3, 0.4});
    for (std::size_t k = 0; k < 3; ++k) CHECK(c[k] == Approx(painted[k]).margin(6));
    CHECK(base_image(bake(asset, unchanged(asset), encoded_as(ImageFormat::source))).mime_type ==
          "image/png");
    asset.images[0] = encode_jpeg(ramp(64), "photo", 95, Content::color);
    CHECK(base_image(bake(asset, unchanged(asset), encoded_as(ImageFormat::source))).mime_type ==
          "image/jpeg");
}

TEST_CASE("images with alpha stay PNG") {
    Asset asset = textured_square(ramp(16));
    asset.materials[0].alpha_mode = AlphaMode::blend;
    CHECK(base_image(bake(asset, unchanged(asset), encoded_as(ImageFormat::jpeg))).mime_type == "image/png");
}

TEST_CASE("a lower JPEG quality makes fewer bytes") {
    const Asset asset = textured_square(paint(64, 64, [](std::uint32_t x, std::uint32_t y) {
        return Rgba{static_cast<std::uint8_t>(x * 37 + y * 91), static_cast<std::uint8_t>(x * y), 9, 255};
    }));
    Options low = encoded_as(ImageFormat::jpeg), high = low;
    low.bake.jpeg_quality = 20;
    high.bake.jpeg_quality = 95;
    CHECK(base_image(bake(asset, unchanged(asset), low)).encoded.size() * 2 <
          base_image(bake(asset, unchanged(asset), high)).encoded.size());
}

TEST_CASE("a page has as many texels per length as are asked for, beside those of the source") {
    const Asset asset = textured_square(ramp(128));
    for (const double factor : {0.25, 0.5, 1.0, 2.0}) {
        Options options;
        options.bake.texel_density = factor;
        const BakedPage page = bake(asset, unchanged(asset), options).report.pages[0];
        CHECK(page.density > 0.9 * factor);
        CHECK(page.density < 1.6 * factor);
    }
}

TEST_CASE("a page much coarser than the source is told of, unless that was asked for") {
    // Tiled ten times each way.
    Asset asset = textured_square(ramp(128));
    asset.materials[0].base_color_texture.wrap_u = asset.materials[0].base_color_texture.wrap_v =
        Wrap::repeat;
    for (Vec2f& uv : asset.parts[0].uvs[0]) uv = {10 * uv[0], 10 * uv[1]};
    Options options;
    options.bake.texture_size = 128;
    const SimplifiedAsset light = bake(asset, unchanged(asset), options);
    REQUIRE(light.report.warnings.size() == 1);
    CHECK(light.report.warnings[0] ==
          "atlas of material 'paint': one texel for 11 x 11 of the source's; texture_size is 128");
    options.bake.texel_density = 0.125;
    CHECK(bake(asset, unchanged(asset), options).report.warnings.empty());
    options.bake.texture_size = 2048;
    options.bake.texel_density.reset();
    CHECK(bake(asset, unchanged(asset), options).report.warnings.empty());
}

TEST_CASE("where nothing is asked for, small pages are finer than the source, and large ones are not") {
    const auto density = [](std::uint32_t side, std::optional<double> asked) {
        const Asset asset = textured_square(ramp(side));
        Options options;
        options.bake.texel_density = asked;
        return bake(asset, unchanged(asset), options).report.pages[0].density;
    };
    CHECK(density(256, {}) > 1.3 * density(256, 1.0));
    CHECK(density(700, {}) == density(700, 1.0));
}

TEST_CASE("the report tells how full and how fine a page is, and how its samples were found") {
    const Asset asset = textured_square(ramp(128));
    const SimplifiedAsset light = bake(asset, unchanged(asset), {});
    REQUIRE(light.report.pages.size() == 1);
    const BakedPage& page = light.report.pages[0];
    CHECK(page.material == "paint");
    CHECK(page.width == decode(base_image(light)).width);
    CHECK(page.fill > 0.5);
    CHECK(page.fill <= 1);
    CHECK(page.density > 1.3);
    CHECK(page.density < 2);
    CHECK(double(page.samples[0]) == Approx(4 * page.fill * page.width * page.height));
    CHECK(page.samples[1] + page.samples[2] == 0);
    CHECK(page.uncertain_texels == 0);
    Options closest;
    closest.bake.mapping = Mapping::closest;
    const BakedPage other = bake(asset, unchanged(asset), closest).report.pages[0];
    CHECK(other.samples[2] == page.samples[0]);
    CHECK(double(other.uncertain_texels) == Approx(page.fill * page.width * page.height));
}

TEST_CASE("the correspondence names the place of each texel on the original") {
    const Asset asset = textured_square(ramp(64));
    Options options;
    options.bake.correspondence = Recording::on;
    const SimplifiedAsset light = bake(asset, unchanged(asset), options);
    REQUIRE(light.correspondence.size() == 1);
    const PageOrigins& page = light.correspondence[0];
    const Pixels atlas = decode(base_image(light));
    REQUIRE(page.texels.size() == std::size_t{atlas.width} * atlas.height);
    CHECK(page.material == 0);
    std::size_t shown = 0;
    for (std::size_t i = 0; i < page.texels.size(); ++i) {
        const TexelOrigin& texel = page.texels[i];
        if (texel.part == no_index) continue;
        ++shown;
        const auto there = look(asset.parts[0], ramp(64), texel.point.face, texel.point.barycentric);
        CHECK(atlas.rgba[4 * i] == Approx(there[0]).margin(4));
    }
    CHECK(double(shown) == Approx(light.report.pages[0].fill * double(page.texels.size())));

    std::ostringstream out;
    write(light.correspondence, out);
    const std::string bytes = out.str();
    REQUIRE(bytes.size() == 8 + 4 + 12 + 20 * page.texels.size());
    CHECK(bytes.substr(0, 8) == "FAQEMC01");
    std::uint32_t width = 0;
    std::memcpy(&width, &bytes[16], 4);
    CHECK(width == page.width);
    CHECK(bake(asset, unchanged(asset), {}).correspondence.empty());
    options.bake.kind = Bake::vertex;
    CHECK_THROWS_AS(bake(asset, unchanged(asset), options), OptionError);
}
