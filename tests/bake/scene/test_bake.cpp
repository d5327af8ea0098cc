#include <bit>
#include <cmath>

#include "faqem/error.hpp"
#include "support/catch.hpp"
#include "support/message_of.hpp"
#include "support/scenes.hpp"

using namespace faqem;
using namespace faqem::test;

namespace {

// The largest difference of the channels [0, end) between a source texture at the part's own UVs and a baked
// page, over all faces including their edges and corners. Both parts have the same faces.
double worst(const Part& source, const Pixels& painted, const Part& baked, const Pixels& atlas,
             std::size_t end = 3) {
    double result = 0;
    for (std::size_t f = 0; f < source.triangles.size(); ++f) {
        for (const Vec3& w : spread(24)) {
            const auto expected = look(source, painted, f, w), got = look(baked, atlas, f, w);
            for (std::size_t k = 0; k < end; ++k) result = std::max(result, std::abs(expected[k] - got[k]));
        }
    }
    return result;
}

Pixels base_pixels(const SimplifiedAsset& simplified, std::size_t material = 0) {
    return base_color_image(simplified.asset, material);
}

}  // namespace

TEST_CASE("a baked square has the colours of the source up to the boundaries of its triangles") {
    const Asset asset = textured_square(ramp(128));
    const SimplifiedAsset simplified = bake(asset, unchanged(asset), lossless());
    const Pixels atlas = base_pixels(simplified);
    CHECK(std::has_single_bit(atlas.width));
    CHECK(worst(asset.parts[0], ramp(128), simplified.asset.parts[0], atlas) < 2.5);
    const Material& m = simplified.asset.materials[0];
    CHECK(m.rebaked);
    CHECK(m.name == "paint");
    CHECK(m.metallic == 0);
    CHECK(m.base_color == Vec4f{1, 1, 1, 1});
    CHECK_FALSE(atlas.has_alpha);
    CHECK(simplified.report.warnings.empty());
}

TEST_CASE("adjacent triangles in the atlas do not bleed into each other") {
    // A red and a blue triangle: any read of the other triangle's texels changes the colour.
    const auto split = paint(64, 64, [](std::uint32_t x, std::uint32_t y) {
        return x + y < 63 ? Rgba{255, 0, 0, 255} : Rgba{0, 0, 255, 255};
    });
    Asset asset = textured_square(split);
    Part& part = asset.parts[0];
    // Each face uses a corner of the texture that has a single colour.
    part.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    part.triangles = {{0, 1, 2}, {3, 4, 5}};
    part.uvs = {{{0, 0}, {0.4f, 0}, {0, 0.4f}, {1, 1}, {0.6f, 1}, {1, 0.6f}}};
    const SimplifiedAsset simplified = bake(asset, unchanged(asset), lossless(GENERATE(64u, 256u)));
    CHECK(worst(part, split, simplified.asset.parts[0], base_pixels(simplified)) < 0.01);
}

TEST_CASE("base colour factor and vertex colours are applied in linear light") {
    Asset asset = textured_square(paint(8, 8, [](std::uint32_t, std::uint32_t) {
        return Rgba{188, 255, 255, 255};
    }));
    asset.materials[0].base_color = {0.5f, 0.25f, 1, 1};
    asset.parts[0].colors.assign(4, {1, 1, 0.5f, 1});
    const SimplifiedAsset simplified = bake(asset, unchanged(asset), lossless());
    const Pixels atlas = base_pixels(simplified);
    const auto c = look(simplified.asset.parts[0], atlas, 0, {0.3, 0.3, 0.4});
    CHECK(c[0] == Approx(137).margin(1));  // sRGB 188 is 0.503 in linear light, half of which is sRGB 137
    CHECK(c[1] == Approx(137).margin(1));
    CHECK(c[2] == Approx(188).margin(1));
    CHECK(simplified.asset.parts[0].colors.empty());
}

TEST_CASE("all texels of a page are filled") {
    const Asset asset = textured_square(paint(32, 32, [](std::uint32_t x, std::uint32_t) {
        return Rgba{9, static_cast<std::uint8_t>(x < 16 ? 99 : 101), 199, 255};
    }));
    const SimplifiedAsset simplified = bake(asset, unchanged(asset), lossless());
    const Pixels atlas = base_pixels(simplified);
    for (std::size_t t = 0; t < atlas.rgba.size(); t += 4) {
        REQUIRE(atlas.rgba[t] == 9);
        REQUIRE(std::abs(atlas.rgba[t + 1] - 100) <= 1);
        REQUIRE(atlas.rgba[t + 2] == 199);
        REQUIRE(atlas.rgba[t + 3] == 255);
    }
}

TEST_CASE("textures with repeat wrap mode are unrolled") {
    Asset asset = textured_square(ramp(32));
    TextureRef& use = asset.materials[0].base_color_texture;
    use.wrap_u = use.wrap_v = Wrap::repeat;
    for (Vec2f& uv : asset.parts[0].uvs[0]) uv = {3 * uv[0] - 1, 2 * uv[1]};
    const SimplifiedAsset simplified = bake(asset, unchanged(asset), lossless());
    const Pixels atlas = base_pixels(simplified), painted = ramp(32);
    std::size_t compared = 0;
    for (std::size_t f = 0; f < 2; ++f) {
        for (const Vec3& w : spread(30)) {
            auto uv = blend(asset.parts[0].uvs[0], asset.parts[0].triangles[f], w);
            for (double& x : uv) x -= std::floor(x);
            if (std::min(uv[0], uv[1]) < 0.1 || std::max(uv[0], uv[1]) > 0.9)
                continue;  // the texture is discontinuous there
            const auto expected = read(painted, uv[0], uv[1]),
                       got = look(simplified.asset.parts[0], atlas, f, w);
            for (std::size_t k = 0; k < 3; ++k) CHECK(got[k] == Approx(expected[k]).margin(4));
            ++compared;
        }
    }
    CHECK(compared > 200);
}

TEST_CASE("materials share a page only if their alpha modes are equal") {
    Asset asset = textured_square(ramp(64));
    asset.materials.resize(3);
    asset.materials[1].name = "green";
    asset.materials[1].base_color = {0, 1, 0, 1};
    asset.materials[1].metallic = 0;
    asset.materials[2].name = "glass";
    asset.materials[2].alpha_mode = AlphaMode::blend;
    asset.materials[2].base_color = {1, 0, 0, 0.5f};
    Part& part = asset.parts[0];
    part.positions.insert(part.positions.end(), {{0, 2, 0}, {1, 2, 0}, {1, 3, 0}});
    part.uvs[0].insert(part.uvs[0].end(), 3, {0, 0});
    part.triangles.push_back({4, 5, 6});
    part.face_material = {0, 1, 2};
    const SimplifiedAsset simplified = bake(asset, unchanged(asset), lossless());
    REQUIRE(simplified.asset.materials.size() == 2);
    CHECK(simplified.asset.parts[0].face_material == std::vector<Index>{0, 0, 1});
    const Pixels atlas = base_pixels(simplified);
    const auto green = look(simplified.asset.parts[0], atlas, 1, {0.3, 0.3, 0.4});
    CHECK(green[0] == 0);
    CHECK(green[1] == 255);
    const auto painted = look(asset.parts[0], ramp(64), 0, {0.3, 0.3, 0.4});
    CHECK(look(simplified.asset.parts[0], atlas, 0, {0.3, 0.3, 0.4})[0] == Approx(painted[0]).margin(2));
    // A single colour needs no image.
    CHECK_FALSE(simplified.asset.materials[1].base_color_texture);
    CHECK(simplified.asset.materials[1].base_color == Vec4f{1, 0, 0, 0.5f});
    CHECK(simplified.asset.materials[1].alpha_mode == AlphaMode::blend);
}

TEST_CASE("materials with extensions are not merged") {
    Asset asset = textured_square(ramp(8));
    asset.materials.push_back(asset.materials[0]);
    asset.materials[1].extensions = {"KHR_materials_clearcoat"};
    asset.materials[1].source = 5;
    asset.parts[0].face_material = {0, 1};
    const SimplifiedAsset simplified = bake(asset, unchanged(asset), lossless());
    REQUIRE(simplified.asset.materials.size() == 2);
    CHECK(simplified.asset.materials[1].source == 5);
    CHECK(simplified.asset.materials[1].extensions == asset.materials[1].extensions);
}

TEST_CASE("alpha masks are preserved and transparent texels do not darken their edges") {
    const auto leaf = paint(64, 64, [](std::uint32_t x, std::uint32_t) {
        return x < 32 ? Rgba{40, 200, 40, 255} : Rgba{0, 0, 0, 0};
    });
    Asset asset = textured_square(leaf);
    asset.materials[0].alpha_mode = AlphaMode::mask;
    asset.materials[0].alpha_cutoff = 0.3f;
    const SimplifiedAsset simplified = bake(asset, unchanged(asset), lossless());
    const Pixels atlas = base_pixels(simplified);
    CHECK(atlas.has_alpha);
    CHECK(simplified.asset.materials[0].alpha_mode == AlphaMode::mask);
    CHECK(simplified.asset.materials[0].alpha_cutoff == 0.3f);
    for (std::size_t f = 0; f < 2; ++f) {
        for (const Vec3& w : spread(20)) {
            const double u = blend(asset.parts[0].uvs[0], asset.parts[0].triangles[f], w)[0];
            const auto c = look(simplified.asset.parts[0], atlas, f, w);
            if (u < 0.45 && u > 0.03) CHECK(c[3] == Approx(255));
            if (u > 0.55 && u < 0.97) CHECK(c[3] == Approx(0).margin(1e-9));
            CHECK(c[0] == Approx(40).margin(2));
            CHECK(c[1] == Approx(200).margin(2));
        }
    }
}

TEST_CASE("the alpha of an opaque material is ignored") {
    Asset asset = textured_square(paint(8, 8, [](std::uint32_t, std::uint32_t) {
        return Rgba{10, 20, 30, 0};
    }));
    const SimplifiedAsset simplified = bake(asset, unchanged(asset), lossless());
    const Pixels atlas = base_pixels(simplified);
    for (std::size_t i = 3; i < atlas.rgba.size(); i += 4) REQUIRE(atlas.rgba[i] == 255);
    const auto c = look(simplified.asset.parts[0], atlas, 0, {0.3, 0.3, 0.4});
    CHECK(c[1] == Approx(20));
    CHECK(c[3] == Approx(255));
}

TEST_CASE("metallic, roughness, occlusion and emissive textures are baked with their factors") {
    Asset asset = textured_square(ramp(16));
    Material& m = asset.materials[0];
    const auto left = [](const Rgba& c) {
        return paint(8, 8, [c](std::uint32_t x, std::uint32_t) {
            return x < 4 ? c : Rgba{255, 255, 255, 255};
        });
    };
    m.metallic = 0.5f;
    m.roughness = 0.8f;
    m.metallic_roughness_texture.image = add_texture(asset, left({7, 100, 200, 255}));
    m.occlusion_texture.image = add_texture(asset, left({55, 0, 0, 255}));
    m.occlusion_strength = 0.5f;
    m.emissive = {1, 0.5f, 0};
    m.emissive_texture.image = add_texture(asset, left({255, 188, 255, 255}));
    m.normal_texture.image = add_texture(asset, left({128, 128, 255, 255}));
    const SimplifiedAsset simplified = bake(asset, unchanged(asset), lossless());
    const Material& out = simplified.asset.materials[0];
    REQUIRE(out.metallic_roughness_texture);
    CHECK(out.metallic_roughness_texture.image == out.occlusion_texture.image);
    CHECK(out.metallic == 1);
    CHECK(out.roughness == 1);
    CHECK(out.occlusion_strength == 1);
    CHECK(out.emissive == Vec3f{1, 1, 1});
    const Pixels orm = decode(simplified.asset.images[out.occlusion_texture.image]);
    const Vec3 on_left = {0.45, 0.1, 0.45};
    const auto o = look(simplified.asset.parts[0], orm, 1, on_left);
    CHECK(o[0] == Approx(155));  // halfway from 255 to 55
    CHECK(o[1] == Approx(80));
    CHECK(o[2] == Approx(100));
    const Pixels glow = decode(simplified.asset.images[out.emissive_texture.image]);
    const auto g = look(simplified.asset.parts[0], glow, 1, on_left);
    CHECK(g[0] == Approx(255));
    CHECK(g[1] == Approx(137).margin(1));
    CHECK(g[2] == Approx(0));
    CHECK(out.normal_texture);
    CHECK(simplified.report.warnings.empty());
}

TEST_CASE("parts share a page") {
    Asset asset = textured_square(ramp(64));
    asset.parts.push_back(square());
    for (Vec3& p : asset.parts[1].positions) p[2] = 5;
    const SimplifiedAsset simplified = bake(asset, unchanged(asset), lossless());
    REQUIRE(simplified.asset.images.size() == 1);
    REQUIRE(simplified.asset.parts.size() == 2);
    CHECK(worst(asset.parts[1], ramp(64), simplified.asset.parts[1], base_pixels(simplified)) < 4);
}

TEST_CASE("pages are not larger than texture_size") {
    const Asset asset = textured_square(ramp(256));
    Options options = lossless(64);
    const SimplifiedAsset simplified = bake(asset, unchanged(asset), options);
    const Pixels atlas = base_pixels(simplified);
    CHECK(atlas.width <= 64);
    CHECK(atlas.height <= 64);
    CHECK(worst(asset.parts[0], ramp(256), simplified.asset.parts[0], atlas) < 6);
}

TEST_CASE("minified textures are averaged") {
    const auto noise = paint(512, 512, [](std::uint32_t x, std::uint32_t y) {
        const std::uint8_t c = (x * 7 + y * 13) % 4 < 2 ? 255 : 0;
        return Rgba{c, c, c, 255};
    });
    const Asset asset = textured_square(noise);
    Options options = lossless(64);
    const SimplifiedAsset simplified = bake(asset, unchanged(asset), options);
    const Pixels atlas = base_pixels(simplified);
    for (std::size_t f = 0; f < 2; ++f) {
        for (const Vec3& w : spread(12))
            CHECK(look(simplified.asset.parts[0], atlas, f, w)[0] == Approx(188).margin(25));
    }
}

TEST_CASE("with more charts or triangles than texels vertex colours are baked with a warning") {
    Asset asset = textured_square(ramp(16));
    Part& part = asset.parts[0];
    for (int i = 0; i < 70 * 70; ++i) part.triangles.push_back(part.triangles[i % 2]);
    part.face_material.assign(part.triangles.size(), 0);
    Options options = lossless(64);
    const SimplifiedAsset simplified = bake(asset, unchanged(asset), options);
    CHECK(simplified.asset.images.empty());
    CHECK(simplified.asset.parts[0].colors.size() == simplified.asset.parts[0].positions.size());
    CHECK(testing::any_contains(simplified.report.warnings, "more charts or triangles than texels"));
    options.bake.kind = Bake::per_triangle;
    CHECK(testing::any_contains(bake(asset, unchanged(asset), options).report.warnings,
                                "more triangles than texels"));
    options.bake.kind = Bake::atlas;
    CHECK(testing::any_contains(bake(asset, unchanged(asset), options).report.warnings,
                                "more charts than texels"));
}

TEST_CASE("only parts that lost faces, or that have no order of their own, may be written in another order") {
    Asset asset;
    asset.parts = {square(),
                   sheet(6,
                         [](double x, double y) {
                             return Vec3{x, y, std::sin(x) * y};
                         }),
                   square()};
    asset.materials.resize(1);
    asset.parts[2].file_order = FileOrder::for_gpu;
    Options options = lossless();
    options.bake.kind = GENERATE(Bake::automatic, Bake::vertex, Bake::keep, Bake::none);
    options.history = GENERATE(Recording::on, Recording::off);
    options.target = faces(40);
    const SimplifiedAsset simplified = simplify(asset, options);
    CHECK(simplified.asset.parts[0].file_order == FileOrder::given);
    CHECK(simplified.asset.parts[1].file_order == FileOrder::for_gpu);
    CHECK(simplified.asset.parts[2].file_order == FileOrder::for_gpu);
    // The faces of the arrays are those of the history, in its order.
    if (options.history != Recording::on) return;
    const TriangleMesh replayed = replay(simplified.histories[1]);
    const Part& part = simplified.asset.parts[1];
    REQUIRE(replayed.triangles.size() == part.triangles.size());
    for (std::size_t f = 0; f < part.triangles.size(); ++f)
        for (std::size_t c = 0; c < 3; ++c)
            CHECK(part.positions[part.triangles[f][c]] == replayed.positions[replayed.triangles[f][c]]);
}

TEST_CASE("the progress callback can cancel bake") {
    const Asset asset = textured_square(ramp(64));
    Options options = lossless();
    int calls = 0;
    options.progress = [&](Phase phase, double fraction) {
        CHECK(fraction >= 0);
        CHECK(fraction <= 1);
        ++calls;
        return phase == Phase::bake ? Continue::cancel : Continue::yes;
    };
    const SimplifiedAsset simplified = bake(asset, unchanged(asset), options);
    CHECK(simplified.report.stop == StopReason::cancelled);
    CHECK(simplified.asset.parts.empty());
    CHECK(calls > 1);
}

TEST_CASE("a damaged image and simplified parts of another asset are rejected") {
    Asset asset = textured_square(ramp(8));
    const SimplifiedParts simplified = unchanged(asset);
    asset.parts.push_back(square());
    CHECK_THROWS_AS(bake(asset, simplified, {}), InputError);
    asset.parts.pop_back();
    asset.images[0].encoded.resize(asset.images[0].encoded.size() / 2);
    CHECK_THROWS_AS(bake(asset, simplified, {}), InputError);
}

TEST_CASE("an asset without faces is accepted") {
    Asset asset;
    asset.parts.resize(2);
    asset.parts[1].source = 3;
    for (Bake kind :
         {Bake::automatic, Bake::atlas, Bake::per_triangle, Bake::vertex, Bake::keep, Bake::none}) {
        Options options = lossless();
        options.bake.kind = kind;
        const SimplifiedAsset simplified = simplify(asset, options);
        REQUIRE(simplified.asset.parts.size() == 2);
        CHECK(simplified.asset.parts[1].source == 3);
        CHECK(simplified.asset.images.empty());
    }
}

// A ball of two halves with a colour each, which share edges.
TEST_CASE("a model without textures keeps its materials and objects at any ratio") {
    Asset source;
    source.materials.resize(3);
    for (std::size_t m = 0; m < 3; ++m) {
        source.materials[m].name = std::string(1, static_cast<char>('a' + m));
        source.materials[m].base_color[m] = 0.25f;
    }
    source.materials[2].base_color = source.materials[0].base_color;  // merged with the first one
    Part part = part_of(icosphere(3));
    part.face_material.clear();
    part.object_names = {"low", "high"};
    for (const Triangle& t : part.triangles) {
        const bool is_high = part.positions[t[0]][2] + part.positions[t[1]][2] + part.positions[t[2]][2] > 0;
        const bool is_east = part.positions[t[0]][0] + part.positions[t[1]][0] + part.positions[t[2]][0] > 0;
        part.face_object.push_back(is_high);
        part.face_material.push_back(is_high ? 1 : is_east ? 0 : 2);
    }
    source.parts = {part};
    Options options{.target = ratio(GENERATE(0.3, 0.05))};
    const Asset result = simplify(source, options).asset;
    CHECK(result.images.empty());
    REQUIRE(result.materials.size() == 2);
    CHECK(result.materials[0].name == "a");
    CHECK(result.materials[1].base_color == source.materials[1].base_color);
    const Part& after = result.parts.at(0);
    CHECK(after.object_names == part.object_names);
    REQUIRE(after.face_object.size() == after.triangles.size());
    for (std::size_t f = 0; f < after.triangles.size(); ++f)
        CHECK(after.face_material[f] == after.face_object[f]);
    CHECK(std::count(after.face_object.begin(), after.face_object.end(), 1) > 0);
    CHECK(std::count(after.face_object.begin(), after.face_object.end(), 0) > 0);
    options.bake.normal_map = NormalMap::on;  // needs a page anyway
    CHECK(simplify(source, options).asset.materials.size() == 1);
}

TEST_CASE("wrong objects of faces are rejected") {
    Asset asset = textured_square(ramp(4));
    asset.parts[0].face_object = {0};
    asset.parts[0].object_names = {"a"};
    CHECK_THROWS_AS(simplify(asset, {}), InputError);
    asset.parts[0].face_object = {0, 1};
    CHECK_THROWS_AS(simplify(asset, {}), InputError);
}

TEST_CASE("of several damaged images, the error names the material of the first") {
    Asset asset = textured_square(ramp(4));
    asset.materials.push_back(asset.materials[0]);
    asset.materials[0].name = "first";
    asset.materials[1].name = "second";
    asset.materials[1].base_color_texture.image = add_texture(asset, ramp(8));
    asset.parts[0].face_material = {0, 1};
    for (Image& image : asset.images) image.encoded.resize(40);
    Options options{.bake = {.kind = Bake::atlas}};
    for (const std::uint32_t threads : {1u, 4u}) {
        options.threads = threads;
        CHECK_THROWS_WITH(bake(asset, unchanged(asset), options), ContainsSubstring("first"));
    }
}
