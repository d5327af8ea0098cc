#include "faqem/compare_colors.hpp"

#include <catch2/catch.hpp>

#include "faqem/error.hpp"
#include "support/scenes.hpp"

using namespace faqem;

namespace {

constexpr CompareOptions few = {.samples = 4000};

Asset painted(const Vec4f& linear, Part part = test::square()) {
    Asset asset;
    asset.materials.resize(1);
    asset.materials[0].base_color = linear;
    asset.parts = {std::move(part)};
    return asset;
}

/// The square at z = 0 that looks up, and one below it that looks down, each with a material of its own.
Asset board(const Vec4f& top, const Vec4f& bottom) {
    Asset asset = painted(top);
    asset.materials.push_back(asset.materials[0]);
    asset.materials[1].base_color = bottom;
    Part& part = asset.parts[0];
    const Part square = part;
    for (const Vec3& p : square.positions) part.positions.push_back({p[0], p[1], -0.01});
    for (const Vec2f& uv : square.uvs[0]) part.uvs[0].push_back(uv);
    for (const Triangle& t : square.triangles) {
        part.triangles.push_back({4 + t[0], 4 + t[2], 4 + t[1]});
        part.face_material.push_back(1);
    }
    return asset;
}

constexpr Vec4f red = {1, 0, 0, 1}, blue = {0, 0, 1, 1}, black = {0, 0, 0, 1}, white = {1, 1, 1, 1};

}  // namespace

TEST_CASE("a model's colours do not differ from its own") {
    const Asset asset = test::textured_square(test::ramp(64));
    const ColorComparison c = compare_colors(asset, asset, few);
    CHECK(c.rmse < 1e-7);
    CHECK(c.psnr > 140);
    CHECK(c.a_to_b.outliers == 0);
    CHECK(c.b_to_a.unmatched == 0);
    CHECK(c.a_to_b.hidden == 0);

    const ColorComparison same = compare_colors(painted(red), painted(red), few);
    CHECK(same.rmse == 0);
    CHECK(same.psnr == std::numeric_limits<double>::infinity());
}

TEST_CASE("red and blue differ in two channels of three") {
    const ColorComparison c = compare_colors(painted(red), painted(blue), few);
    CHECK(c.a_to_b.mean_squared == Approx(2.0 / 3));
    CHECK(c.b_to_a.rmse == Approx(std::sqrt(2.0 / 3)));
    CHECK(c.rmse == Approx(std::sqrt(2.0 / 3)));
    CHECK(c.psnr == Approx(10 * std::log10(1.5)));
    CHECK(c.a_to_b.outliers == 1);
}

TEST_CASE("what differs counts by its area") {
    Asset half = painted(white);
    half.materials.push_back(half.materials[0]);
    half.materials[1].base_color = black;
    half.parts[0].face_material = {0, 1};
    const ColorComparison c = compare_colors(half, painted(white), {.samples = 100000});
    CHECK(c.a_to_b.mean_squared == Approx(0.5));  // the slices of the area are whole on each half
    CHECK(c.b_to_a.mean_squared == Approx(0.5).epsilon(0.02));
    CHECK(c.a_to_b.outliers == Approx(0.5));
}

TEST_CASE("textures and vertex colours meet as sRGB") {
    // Half of the light is 188 of 255 on a screen.
    Asset vertices = painted(white);
    vertices.parts[0].colors.assign(4, {0.5f, 0.5f, 0.5f, 1});
    const Asset texture = test::textured_square(test::paint(4, 4, [](std::uint32_t, std::uint32_t) {
        return test::Rgba{188, 188, 188, 255};
    }));
    CHECK(compare_colors(vertices, texture, few).rmse < 0.5 / 255);
    const ColorComparison to_black = compare_colors(vertices, painted(black), few);
    CHECK(to_black.rmse == Approx(188.0 / 255).epsilon(0.003));
}

TEST_CASE("the two sides of a thin board are not mistaken for each other") {
    // The other board lies deeper by more than half of its thickness: its top is nearer to this one's bottom.
    Asset lower = board(red, blue);
    for (Vec3& p : lower.parts[0].positions) p[2] -= 0.008;
    const ColorComparison c = compare_colors(board(red, blue), lower, few);
    CHECK(c.rmse == 0);
    CHECK(c.a_to_b.unmatched == 0);
}

TEST_CASE("normals say which side is outside, and the winding does where there are none") {
    Asset turned = board(red, blue);
    for (Triangle& t : turned.parts[0].triangles) std::swap(t[1], t[2]);
    CHECK(compare_colors(board(red, blue), turned, few).rmse == Approx(std::sqrt(2.0 / 3)));
    turned.parts[0].normals.assign(4, {0, 0, 1});
    turned.parts[0].normals.resize(8, {0, 0, -1});
    CHECK(compare_colors(board(red, blue), turned, few).rmse == 0);
}

TEST_CASE("where no face looks the same way the closest one counts, and is counted") {
    Asset turned = painted(red);
    for (Triangle& t : turned.parts[0].triangles) std::swap(t[1], t[2]);
    const ColorComparison c = compare_colors(painted(red), turned, few);
    CHECK(c.a_to_b.unmatched == 1);
    CHECK(c.rmse == 0);
}

TEST_CASE("what is masked out does not count, and alpha does not dim") {
    // The left half is cut away; the right half shows white at half the alpha.
    Asset asset = test::textured_square(test::paint(64, 4, [](std::uint32_t x, std::uint32_t) {
        return x < 32 ? test::Rgba{0, 0, 0, 0} : test::Rgba{255, 255, 255, 128};
    }));
    asset.materials[0].base_color_texture.filter = Filter::nearest;
    asset.materials[0].alpha_mode = AlphaMode::mask;
    asset.materials[0].alpha_cutoff = 0.4f;
    const ColorComparison c = compare_colors(asset, painted(white), few);
    CHECK(c.a_to_b.hidden == Approx(0.5).epsilon(0.02));
    CHECK(c.a_to_b.mean_squared < 1e-6);
    CHECK(c.b_to_a.hidden == 0);
}

TEST_CASE("colours do not depend on the number of threads, but on the seed") {
    const Asset a = test::textured_square(test::ramp(64)), b = painted(red);
    CompareOptions options = {.samples = 20000, .threads = 1};
    const double one = compare_colors(a, b, options).rmse;
    options.threads = 3;
    CHECK(compare_colors(a, b, options).rmse == one);
    options.seed = 2;
    CHECK(compare_colors(a, b, options).rmse != one);
}

TEST_CASE("models without colours are told, models without area and broken images are refused") {
    Asset bare = painted(red);
    CHECK(has_colors(bare));
    bare.materials.clear();
    bare.parts[0].face_material.clear();
    CHECK_FALSE(has_colors(bare));
    bare.parts[0].colors.assign(4, {1, 1, 1, 1});
    CHECK(has_colors(bare));

    Asset flat = painted(red);
    for (Vec3& p : flat.parts[0].positions) p[1] = 0;
    CHECK_THROWS_AS(compare_colors(painted(red), flat, few), InputError);

    Asset broken = test::textured_square(test::ramp(8));
    broken.images[0].encoded.resize(40);
    CHECK_THROWS_AS(compare_colors(broken, painted(red), few), InputError);
}
