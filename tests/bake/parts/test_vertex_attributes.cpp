#include <algorithm>
#include <cmath>

#include "faqem/error.hpp"
#include "support/catch.hpp"
#include "support/scenes.hpp"

using namespace faqem;
using namespace faqem::test;

namespace {

Options of_kind(Bake kind) { return {.bake = {.kind = kind}}; }

// The cube [0, 1]^3 with 8 vertices and no normals.
Asset cube_asset() {
    Asset asset;
    asset.parts = {part_of(cube())};
    return asset;
}

double dot(const Vec3f& a, const Vec3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

double length(const Vec3f& a) {
    return std::sqrt(double(a[0]) * a[0] + double(a[1]) * a[1] + double(a[2]) * a[2]);
}

// A strip of n squares around a cylinder of radius 1, with exact normals.
Asset pipe(int n) {
    Asset asset;
    asset.parts.resize(1);
    Part& part = asset.parts[0];
    for (int i = 0; i <= n; ++i) {
        const double a = i * 1.5 / n;
        for (double y : {0.0, 1.0}) {
            part.positions.push_back({std::cos(a), y, -std::sin(a)});
            part.normals.push_back({static_cast<float>(std::cos(a)), 0, static_cast<float>(-std::sin(a))});
        }
    }
    for (Index i = 0; i < Index(2 * n); i += 2) {
        part.triangles.push_back({i, i + 2, i + 3});
        part.triangles.push_back({i, i + 3, i + 1});
    }
    return asset;
}

// Checks that the normals of a pipe are perpendicular to its axis, outwards.
void check_radial(const Part& part) {
    for (std::size_t v = 0; v < part.positions.size(); ++v)
        CHECK(dot(part.normals[v], {part.positions[v][0], 0, part.positions[v][2]}) > 0.9999);
}

// Checks that the corners of the faces have the colours that they have in the source.
void check_same_colors(const Part& part, const Part& source) {
    REQUIRE(part.colors.size() == part.positions.size());
    for (std::size_t f = 0; f < source.triangles.size(); ++f) {
        for (std::size_t c = 0; c < 3; ++c) {
            const Vec4f &got = part.colors[part.triangles[f][c]],
                        &expected = source.colors[source.triangles[f][c]];
            for (std::size_t k = 0; k < 4; ++k) CHECK(got[k] == Approx(expected[k]).margin(2e-3));
        }
    }
}

}  // namespace

TEST_CASE("normals of a cube are split only at its edges") {
    const Asset asset = cube_asset();
    const SimplifiedAsset simplified = bake(asset, unchanged(asset), of_kind(Bake::none));
    const Part& part = simplified.asset.parts[0];
    CHECK(part.positions.size() == 24);
    REQUIRE(part.normals.size() == 24);
    for (const Triangle& t : part.triangles) {
        for (Index v : t) {
            CHECK(length(part.normals[v]) == Approx(1));
            CHECK(std::max({std::abs(part.normals[v][0]), std::abs(part.normals[v][1]),
                            std::abs(part.normals[v][2])}) == Approx(1));
        }
    }
    Options smooth = of_kind(Bake::none);
    smooth.bake.crease_angle = 120;
    const Part rounded = bake(asset, unchanged(asset), smooth).asset.parts[0];
    CHECK(rounded.positions.size() == 8);
    for (std::size_t v = 0; v < 8; ++v) {
        for (std::size_t k = 0; k < 3; ++k) {
            const double outward = rounded.positions[v][k] > 0.5 ? 1 : -1;
            CHECK(rounded.normals[v][k] * outward == Approx(1 / std::sqrt(3.0)).margin(1e-6));
        }
    }
}

TEST_CASE("smooth normals of the source are preserved") {
    const Asset asset = pipe(40);
    const SimplifiedAsset simplified = bake(asset, unchanged(asset), of_kind(Bake::none));
    const Part& part = simplified.asset.parts[0];
    CHECK(part.positions.size() == asset.parts[0].positions.size());
    check_radial(part);
}

TEST_CASE("normals are preserved on faces with reversed winding") {
    Asset asset = pipe(40);
    Part& part = asset.parts[0];
    for (std::size_t f = 0; f < part.triangles.size(); f += 3) {
        std::swap(part.triangles[f][0], part.triangles[f][1]);
    }
    const Part simplified = bake(asset, unchanged(asset), of_kind(Bake::none)).asset.parts[0];
    check_radial(simplified);
    CHECK(simplified.positions.size() == part.positions.size());
}

TEST_CASE("normals are finite and within 90 degrees of the face normal") {
    Asset asset = pipe(4);
    for (Vec3f& n : asset.parts[0].normals) n = {-n[0], -n[1], -n[2]};
    asset.parts[0].normals[0] = {0, 0, 0};
    asset.parts[0].triangles.push_back({0, 0, 2});  // degenerate
    for (Bake kind : {Bake::none, Bake::vertex}) {
        const Part part = bake(asset, unchanged(asset), of_kind(kind)).asset.parts[0];
        for (std::size_t f = 0; f < 8; ++f) {
            for (Index v : part.triangles[f]) {
                CHECK(length(part.normals[v]) == Approx(1));
                CHECK(dot(part.normals[v], {part.positions[v][0], 0, part.positions[v][2]}) > 0);
            }
        }
        for (const Vec3f& n : part.normals) CHECK(length(n) == Approx(1));
    }
}

TEST_CASE("normals that are perpendicular to their faces in the source stay so") {
    // Upright cards whose normals all point up, as those of grass.
    Asset asset = pipe(16);
    asset.parts[0].normals.assign(asset.parts[0].positions.size(), {0, 1, 0});
    const Part part = simplify(asset, {.target = ratio(0.5), .bake = {.kind = Bake::none}}).asset.parts[0];
    CHECK(part.triangles.size() == 16);
    for (const Vec3f& n : part.normals) CHECK(n[1] > 0.999f);
}

TEST_CASE("normals stay apart where those of the source are, on facets as large as the faces") {
    // Strips of a prism that turn by 21 degrees, with a normal each: less than the angle that is averaged.
    constexpr int strips = 4;
    Asset asset = pipe(strips), faceted;
    faceted.parts.resize(1);
    Part& part = faceted.parts[0];
    for (std::size_t f = 0; f < asset.parts[0].triangles.size(); ++f) {
        const double middle = (static_cast<double>(f / 2) + 0.5) * 1.5 / strips;
        for (const Index v : asset.parts[0].triangles[f]) {
            part.positions.push_back(asset.parts[0].positions[v]);
            part.normals.push_back(
                {static_cast<float>(std::cos(middle)), 0, static_cast<float>(-std::sin(middle))});
        }
        const auto first = static_cast<Index>(3 * f);
        part.triangles.push_back({first, first + 1, first + 2});
    }
    const Part result = simplify(faceted, {.target = ratio(1), .bake = {.kind = Bake::none}}).asset.parts[0];
    CHECK(result.positions.size() == 4 * strips);
    for (const Triangle& t : result.triangles)
        for (const Index v : t)
            CHECK(dot(result.normals[v], {result.normals[t[0]][0], 0, result.normals[t[0]][2]}) > 0.9999);
}

TEST_CASE("vertex colours of the source are preserved") {
    Asset asset = pipe(10);
    Part& part = asset.parts[0];
    for (std::size_t v = 0; v < part.positions.size(); ++v)
        part.colors.push_back({v / 22.0f, 0.5f, 1 - v / 22.0f, 1});
    const SimplifiedAsset simplified = bake(asset, unchanged(asset), of_kind(Bake::vertex));
    check_same_colors(simplified.asset.parts[0], part);
    CHECK(simplified.asset.images.empty());
}

TEST_CASE("the alpha of vertex colours without a material is kept and does not weight colours") {
    Asset asset = pipe(10);
    Part& part = asset.parts[0];
    part.face_material.clear();
    for (std::size_t v = 0; v < part.positions.size(); ++v)
        part.colors.push_back({v / 22.0f, 0.5f, 0, v < 2 ? 0 : v / 22.0f});
    check_same_colors(bake(asset, unchanged(asset), of_kind(Bake::vertex)).asset.parts[0], part);
}

TEST_CASE("vertex colours include texture, factor and alpha and are split between materials") {
    Asset asset = textured_square(paint(8, 8, [](std::uint32_t, std::uint32_t) {
        return Rgba{255, 188, 0, 255};
    }));
    asset.materials.resize(2);
    asset.materials[0].alpha_mode = asset.materials[1].alpha_mode = AlphaMode::blend;
    asset.materials[0].base_color = {0.5f, 1, 1, 0.25f};
    asset.materials[1].base_color = {0, 0, 1, 1};
    asset.materials[1].double_sided = true;
    asset.parts[0].face_material = {0, 1};
    const SimplifiedAsset simplified = simplify(asset, {.target = ratio(1), .bake = {.kind = Bake::vertex}});
    const Part& part = simplified.asset.parts[0];
    REQUIRE(part.triangles.size() == 2);
    CHECK(part.positions.size() == 6);
    const auto close = [](const Vec4f& a, const Vec4f& b) {
        for (std::size_t k = 0; k < 4; ++k) CHECK(a[k] == Approx(b[k]).margin(1e-2));
    };
    for (Index v : part.triangles[0]) close(part.colors[v], {0.5f, 0.5f, 0, 0.25f});
    for (Index v : part.triangles[1]) close(part.colors[v], {0, 0, 1, 1});
    for (const Material& m : simplified.asset.materials) CHECK(m.base_color == Vec4f{1, 1, 1, 1});
    CHECK(simplified.asset.materials[part.face_material[1]].double_sided);
}

TEST_CASE("vertex colours under an alpha of 0 are those of the source") {
    Asset asset = textured_square(paint(8, 8, [](std::uint32_t, std::uint32_t) {
        return Rgba{255, 188, 0, 0};
    }));
    asset.materials[0].alpha_mode = AlphaMode::blend;
    asset.materials[0].base_color = {0.5f, 1, 1, 1};
    const SimplifiedAsset simplified = bake(asset, unchanged(asset), of_kind(Bake::vertex));
    for (const Vec4f& color : simplified.asset.parts[0].colors) {
        CHECK(color[0] == Approx(0.5f));
        CHECK(color[1] == Approx(0.5f).margin(5e-3));
        CHECK(color[2] == 0);
        CHECK(color[3] == 0);
    }
}

TEST_CASE("keep preserves UVs, colours, images and materials") {
    Asset asset = textured_square(ramp(8));
    asset.parts[0].uvs.push_back({{0, 0}, {2, 0}, {2, 2}, {0, 2}});
    asset.parts[0].colors = {{1, 0, 0, 1}, {0, 1, 0, 1}, {0, 0, 1, 1}, {1, 1, 1, 0.5f}};
    Options options = of_kind(Bake::keep);
    options.target = ratio(1);
    options.bake.untouched = GENERATE(UntouchedParts::baked, UntouchedParts::kept);
    const SimplifiedAsset simplified = simplify(asset, options);
    const Part &in = asset.parts[0], &out = simplified.asset.parts[0];
    REQUIRE(out.triangles.size() == 2);
    REQUIRE(out.uvs.size() == 2);
    for (std::size_t v = 0; v < out.positions.size(); ++v) {
        std::size_t from = 0;
        while (in.positions[from] != out.positions[v]) ++from;
        CHECK(out.uvs[0][v] == in.uvs[0][from]);
        CHECK(out.uvs[1][v] == in.uvs[1][from]);
        CHECK(out.colors[v] == in.colors[from]);
    }
    CHECK(simplified.asset.images[0].encoded == asset.images[0].encoded);
    CHECK(simplified.asset.materials[0].base_color_texture.image == 0);
    CHECK_FALSE(simplified.asset.materials[0].rebaked);
    CHECK_THROWS_AS(bake(asset, unchanged(asset), options), InputError);
}

TEST_CASE("none removes textures with a warning") {
    Asset asset = textured_square(ramp(8));
    asset.materials[0].base_color = {0.1f, 0.2f, 0.3f, 1};
    const SimplifiedAsset simplified = bake(asset, unchanged(asset), of_kind(Bake::none));
    CHECK(simplified.asset.parts[0].uvs.empty());
    CHECK(simplified.asset.images.empty());
    CHECK(simplified.asset.materials[0].base_color == asset.materials[0].base_color);
    REQUIRE(simplified.report.warnings.size() == 1);
    CHECK(simplified.report.warnings[0].find("'paint': textures left out: base colour") != std::string::npos);
}

TEST_CASE("skin weights and morph targets are transferred without cracks") {
    Asset asset = cube_asset();
    Part& part = asset.parts[0];
    part.morph_targets.resize(1);
    for (std::size_t v = 0; v < 8; ++v) {
        part.joints.push_back({static_cast<std::uint16_t>(v), 9, 0, 0});
        part.weights.push_back({0.75f, 0.25f, 0, 0});
        part.morph_targets[0].positions.push_back({float(v), 0, 1});
    }
    for (Bake kind : {Bake::per_triangle, Bake::vertex, Bake::none}) {
        const Part out = bake(asset, unchanged(asset), of_kind(kind)).asset.parts[0];
        REQUIRE(out.joints.size() == out.positions.size());
        REQUIRE(out.weights.size() == out.positions.size());
        REQUIRE(out.morph_targets.size() == 1);
        for (std::size_t v = 0; v < out.positions.size(); ++v) {
            std::size_t from = 0;
            while (part.positions[from] != out.positions[v]) ++from;
            CHECK(out.joints[v][0] == from);
            CHECK(out.joints[v][1] == 9);
            CHECK(out.weights[v][0] == Approx(0.75));
            CHECK(out.weights[v][1] == Approx(0.25));
            CHECK(out.morph_targets[0].positions[v] == part.morph_targets[0].positions[from]);
        }
    }
}

TEST_CASE("interpolated skin weights keep the four largest and sum to one") {
    // The collapse places a vertex inside a source triangle, so that its weights are interpolated.
    Asset asset;
    asset.parts.resize(1);
    Part& part = asset.parts[0];
    part.positions = {{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {2, 2, 0}};
    part.triangles = {{0, 1, 2}, {1, 3, 2}};
    part.joints = {{0, 1, 2, 3}, {4, 5, 6, 7}, {8, 9, 10, 11}, {0, 0, 0, 0}};
    part.weights.assign(4, {0.4f, 0.3f, 0.2f, 0.1f});
    HandHistory hand(part.positions, part.triangles);
    hand.collapse(1, 3, {0.8, 0.7, 0});
    SimplifiedParts simplified;
    simplified.parts.resize(1);
    simplified.parts[0].history = hand.finish();
    simplified.parts[0].mesh = small_mesh(simplified.parts[0].history);
    const Part out = bake(asset, simplified, of_kind(Bake::none)).asset.parts[0];
    bool blended = false;
    for (std::size_t v = 0; v < out.positions.size(); ++v) {
        double sum = 0;
        for (float w : out.weights[v]) sum += w;
        CHECK(sum == Approx(1));
        CHECK(out.weights[v][0] >= out.weights[v][3]);
        if (out.positions[v][0] != 0.8) continue;
        blended = true;
        // The barycentric coordinates are 0.25, 0.4 and 0.35. The largest weights are 0.16 of joint 4, 0.14
        // of joint 8, 0.12 of joint 5, and 0.105 of joint 9.
        CHECK(out.joints[v] == std::array<std::uint16_t, 4>{4, 8, 5, 9});
        CHECK(out.weights[v][0] == Approx(0.16 / 0.525));
    }
    CHECK(blended);
}

TEST_CASE("vertex colours without normals are split where those of the source are and not at creases") {
    Options options = of_kind(Bake::vertex);
    options.bake.normals = Normals::none;
    Asset asset = cube_asset();
    asset.parts[0].colors.assign(8, Vec4f{0, 1, 0, 1});
    CHECK(bake(asset, unchanged(asset), options).asset.parts[0].positions.size() == 8);

    // The face z = 1 is red.
    Part& part = asset.parts[0];
    for (Index v = 4; v < 8; ++v) {
        part.positions.push_back(part.positions[v]);
        part.colors.push_back({1, 0, 0, 1});
    }
    part.triangles[2] = {8, 9, 11};
    part.triangles[3] = {8, 11, 10};
    const Part split = bake(asset, unchanged_welded(asset), options).asset.parts[0];
    CHECK(split.positions.size() == 12);
    for (const Vec4f& color : split.colors) CHECK((color[0] == 0 || color[0] == 1));
}

TEST_CASE("each of several closed fans of faces at a vertex gets a vertex of its own, open ones share it") {
    Options options = of_kind(Bake::none);
    options.bake.normals = Normals::none;
    // Two tetrahedra that touch at vertex 0.
    Asset asset;
    asset.parts.resize(1);
    Part& part = asset.parts[0];
    part.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {-1, 0, 0}, {0, -1, 0}, {0, 0, -1}};
    part.triangles = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}, {0, 4, 5}, {0, 6, 4}, {0, 5, 6}, {4, 6, 5}};
    const Asset apart = bake(asset, unchanged(asset), options).asset;
    CHECK(apart.parts[0].positions.size() == 8);
    CHECK(std::count(apart.parts[0].positions.begin(), apart.parts[0].positions.end(), Vec3{0, 0, 0}) == 2);
    part.triangles.erase(part.triangles.begin());
    CHECK(bake(asset, unchanged(asset), options).asset.parts[0].positions.size() == 7);
}
