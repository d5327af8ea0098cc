#include "faqem/compare_colors.hpp"

#include <cmath>

#include "faqem/bake.hpp"
#include "faqem/error.hpp"
#include "support/catch.hpp"
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

/// A square at z = 0 that faces up, and one below it that faces down, with a material each.
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

TEST_CASE("a model has no colour difference from itself") {
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

TEST_CASE("red and blue differ in two of three channels") {
    const ColorComparison c = compare_colors(painted(red), painted(blue), few);
    CHECK(c.a_to_b.mean_squared == Approx(2.0 / 3));
    CHECK(c.b_to_a.rmse == Approx(std::sqrt(2.0 / 3)));
    CHECK(c.rmse == Approx(std::sqrt(2.0 / 3)));
    CHECK(c.psnr == Approx(10 * std::log10(1.5)));
    CHECK(c.a_to_b.outliers == 1);
}

TEST_CASE("colour differences are weighted by area") {
    Asset half = painted(white);
    half.materials.push_back(half.materials[0]);
    half.materials[1].base_color = black;
    half.parts[0].face_material = {0, 1};
    const ColorComparison c = compare_colors(half, painted(white), {.samples = 100000});
    CHECK(c.a_to_b.mean_squared == Approx(0.5));  // samples are stratified by area
    CHECK(c.b_to_a.mean_squared == Approx(0.5).epsilon(0.02));
    CHECK(c.a_to_b.outliers == Approx(0.5));
}

TEST_CASE("textures and vertex colours are compared in sRGB") {
    // A linear value of 0.5 is 188 of 255 in sRGB.
    Asset vertices = painted(white);
    vertices.parts[0].colors.assign(4, {0.5f, 0.5f, 0.5f, 1});
    const Asset texture = test::textured_square(test::paint(4, 4, [](std::uint32_t, std::uint32_t) {
        return test::Rgba{188, 188, 188, 255};
    }));
    CHECK(compare_colors(vertices, texture, few).rmse < 0.5 / 255);
    const ColorComparison to_black = compare_colors(vertices, painted(black), few);
    CHECK(to_black.rmse == Approx(188.0 / 255).epsilon(0.003));
}

TEST_CASE("samples of a thin board are compared with faces of the same orientation") {
    // The second board is lower by more than half of its thickness: its top is closer to the bottom of the
    // first.
    Asset lower = board(red, blue);
    for (Vec3& p : lower.parts[0].positions) p[2] -= 0.008;
    const ColorComparison c = compare_colors(board(red, blue), lower, few);
    CHECK(c.rmse == 0);
    CHECK(c.a_to_b.unmatched == 0);
}

TEST_CASE("faces are oriented by vertex normals or else by their winding") {
    Asset turned = board(red, blue);
    for (Triangle& t : turned.parts[0].triangles) std::swap(t[1], t[2]);
    CHECK(compare_colors(board(red, blue), turned, few).rmse == Approx(std::sqrt(2.0 / 3)));
    turned.parts[0].normals.assign(4, {0, 0, 1});
    turned.parts[0].normals.resize(8, {0, 0, -1});
    CHECK(compare_colors(board(red, blue), turned, few).rmse == 0);
}

TEST_CASE("without a face of the same orientation the closest one is used and counted as unmatched") {
    Asset turned = painted(red);
    for (Triangle& t : turned.parts[0].triangles) std::swap(t[1], t[2]);
    const ColorComparison c = compare_colors(painted(red), turned, few);
    CHECK(c.a_to_b.unmatched == 1);
    CHECK(c.rmse == 0);
}

TEST_CASE("masked samples are hidden and alpha does not change the colour") {
    // The left half is masked; the right half is white with an alpha of 0.5.
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

TEST_CASE("compare_colors depends on the seed and not on the number of threads") {
    const Asset a = test::textured_square(test::ramp(64)), b = painted(red);
    CompareOptions options = {.samples = 20000, .threads = 1};
    const double one = compare_colors(a, b, options).rmse;
    options.threads = 3;
    CHECK(compare_colors(a, b, options).rmse == one);
    options.seed = 2;
    CHECK(compare_colors(a, b, options).rmse != one);
}

TEST_CASE("models without colours are detected and models without area or with damaged images rejected") {
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

TEST_CASE("a new page shows where colours end, also if UVs are points of a palette") {
    // Stripes in two colours. All corners of a face are at the middle of one of two texels.
    Asset asset;
    asset.parts = {test::sheet(24, [](double x, double y) { return Vec3{x, y, 0.1 * std::sin(x / 4)}; })};
    Part& part = asset.parts[0];
    asset.materials.resize(1);
    asset.images.push_back(encode_png({2, 1, {255, 0, 0, 255, 0, 0, 255, 255}, false}, "palette"));
    asset.materials[0].base_color_texture.image = 0;
    const Part grid = part;
    part.positions.clear();
    part.triangles.clear();
    part.normals.clear();
    part.uvs.assign(1, {});
    for (Index f = 0; f < grid.triangles.size(); ++f) {
        const float u = f / 2 % 24 / 6 % 2 == 0 ? 0.25f : 0.75f;
        for (const Index v : grid.triangles[f]) {
            part.positions.push_back(grid.positions[v]);
            part.uvs[0].push_back({u, 0.5f});
        }
        part.triangles.push_back({3 * f, 3 * f + 1, 3 * f + 2});
    }
    part.face_material.assign(part.triangles.size(), 0);
    Options options{.target = ratio(0.1)};
    options.bake.kind = Bake::atlas;
    const SimplifiedAsset result = simplify(asset, options);
    REQUIRE(result.report.pages.size() == 1);
    // A texel on each side of a boundary may be a mixture.
    CHECK(compare_colors(asset, result.asset, few).a_to_b.rmse < 0.25);
}
