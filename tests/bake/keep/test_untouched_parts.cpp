// Parts that the simplification leaves as they are keep their vertices, materials and images.

#include <array>
#include <cmath>

#include "faqem/bake_levels.hpp"
#include "faqem/truncate.hpp"
#include "support/catch.hpp"
#include "support/scenes.hpp"

using namespace faqem;
using namespace faqem::test;

namespace {

bool same_arrays(const Part& a, const Part& b) {
    return a.name == b.name && a.positions == b.positions && a.triangles == b.triangles &&
           a.face_material == b.face_material && a.normals == b.normals && a.tangents == b.tangents &&
           a.uvs == b.uvs && a.colors == b.colors && a.joints == b.joints && a.weights == b.weights &&
           a.source == b.source && a.file_order == b.file_order;
}

/// A square with unused attributes and a vertex order that baking would not give.
Part odd_square() {
    Part part = square();
    part.name = "odd";
    part.positions = {{0, 1, 0}, {1, 1, 0}, {1, 0, 0}, {0, 0, 0}};
    part.triangles = {{3, 2, 1}, {3, 1, 0}};
    part.uvs = {{{0, 0}, {1, 0}, {1, 1}, {0, 1}}, {{0.5f, 0}, {3, 0}, {1, -1}, {0, 1}}};
    part.colors = {{1, 1, 1, 1}, {0, 1, 1, 1}, {1, 0, 1, 1}, {1, 1, 0, 1}};
    return part;
}

Part textured_sheet(Index n) {
    Part part = uv_mapped(sheet(n, [n](double x, double y) {
        return Vec3{x / n, y / n, 0.1 * std::sin(3 * x) * y / n};
    }));
    part.name = "sheet";
    return part;
}

/// A sheet and a small part with a texture in common; the small part has a second material too.
Asset sheet_and_square() {
    Asset asset = textured_square(ramp(64));
    asset.materials.resize(2);
    asset.materials[1].name = "other";
    asset.materials[1].base_color_texture.image = add_texture(asset, ramp(32));
    asset.parts = {textured_sheet(12), odd_square()};
    asset.parts[1].face_material = {1, 0};
    return asset;
}

}  // namespace

TEST_CASE("untouched: a part with no more faces than the target keeps its arrays and image bytes") {
    Asset asset = textured(ramp(64), odd_square());
    Options options{.target = GENERATE(ratio(1), faces(1000))};
    options.bake.kind = GENERATE(Bake::automatic, Bake::keep);
    options.bake.image_format = GENERATE(ImageFormat::automatic, ImageFormat::source);
    options.history = GENERATE(Recording::off, Recording::on);
    const SimplifiedAsset simplified = simplify(asset, options);
    CHECK(same_arrays(simplified.asset.parts[0], asset.parts[0]));
    REQUIRE(simplified.asset.materials.size() == 1);
    CHECK_FALSE(simplified.asset.materials[0].rebaked);
    CHECK(simplified.asset.materials[0].name == "paint");
    REQUIRE(simplified.asset.images.size() == 1);
    CHECK(simplified.asset.images[0].encoded == asset.images[0].encoded);
    CHECK(simplified.report.untouched_parts == std::vector<std::string>{"part 'odd'"});
    CHECK(simplified.report.pages.empty());
    CHECK(simplified.report.warnings.empty());
    CHECK(simplified.report.faces_out == 2);
    CHECK(simplified.histories.size() == (options.history == Recording::on ? 1u : 0u));
}

TEST_CASE("untouched: an option that would change the part bakes it") {
    Asset asset = textured(ramp(64), odd_square());
    Options options{.target = ratio(1)};
    BakeOptions& bake = options.bake;
    SECTION("texture size") { bake.texture_size = 256; }
    SECTION("texel density") { bake.texel_density = 1; }
    SECTION("normal map") { bake.normal_map = NormalMap::off; }
    SECTION("image format") { bake.image_format = ImageFormat::jpeg; }
    SECTION("normals") { bake.normals = Normals::flat; }
    SECTION("crease angle") { bake.crease_angle = 10; }
    SECTION("correspondence") { bake.correspondence = Recording::on; }
    SECTION("kind") { bake.kind = GENERATE(Bake::atlas, Bake::per_triangle, Bake::vertex, Bake::none); }
    SECTION("all parts") { bake.untouched = UntouchedParts::baked; }
    const SimplifiedAsset simplified = simplify(asset, options);
    CHECK(simplified.report.untouched_parts.empty());
    CHECK(simplified.asset.materials[0].rebaked);
}

TEST_CASE("untouched: with UntouchedParts::kept no option changes the part") {
    Asset asset = textured(ramp(64), odd_square());
    Options options{.target = ratio(1)};
    options.bake.untouched = UntouchedParts::kept;
    options.bake.texture_size = 64;
    options.bake.kind = GENERATE(Bake::automatic, Bake::atlas, Bake::vertex, Bake::keep);
    const SimplifiedAsset simplified = simplify(asset, options);
    Part expected = asset.parts[0];
    expected.face_material = simplified.asset.parts[0].face_material;
    CHECK(same_arrays(simplified.asset.parts[0], expected));
    const Material& material = simplified.asset.materials[expected.face_material[0]];
    CHECK(simplified.asset.images[material.base_color_texture.image].encoded == asset.images[0].encoded);
}

TEST_CASE("untouched: the other parts of the scene are baked, beside the images that are kept") {
    const Asset asset = sheet_and_square();
    const Options options{.target = faces(100), .bake = {.kind = GENERATE(Bake::automatic, Bake::keep)}};
    const SimplifiedAsset simplified = simplify(asset, options);
    const Asset& result = simplified.asset;
    CHECK(simplified.report.untouched_parts == std::vector<std::string>{"part 'odd'"});
    CHECK(result.parts[0].triangles.size() < asset.parts[0].triangles.size());
    CHECK(result.parts[0].file_order == FileOrder::for_gpu);
    Part expected = asset.parts[1];
    expected.face_material = result.parts[1].face_material;
    CHECK(same_arrays(result.parts[1], expected));
    for (std::size_t f = 0; f < 2; ++f) {
        const Material& before = asset.materials[asset.parts[1].face_material[f]];
        const Material& after = result.materials[expected.face_material[f]];
        CHECK(after.name == before.name);
        CHECK_FALSE(after.rebaked);
        CHECK(result.images[after.base_color_texture.image].encoded ==
              asset.images[before.base_color_texture.image].encoded);
    }
    if (options.bake.kind == Bake::keep) return;
    const Material& page = result.materials[result.parts[0].face_material[0]];
    CHECK(page.rebaked);
    CHECK(simplified.report.pages.size() == 1);
    CHECK(result.images.size() == (page.normal_texture ? 4 : 3));  // two are kept, the others are the page's
    // The material that only the untouched part has is not on the page.
    CHECK(result.materials.size() == 3);
}

TEST_CASE("untouched: images of untouched parts are not decoded") {
    Asset asset = textured(ramp(64), odd_square());
    asset.images[0].encoded.resize(40);
    Options options{.target = ratio(1)};
    CHECK(simplify(asset, options).asset.images[0].encoded == asset.images[0].encoded);
    options.bake.kind = Bake::atlas;
    CHECK_THROWS(simplify(asset, options));
}

TEST_CASE("untouched: duplicate faces are dropped, the rest of the part stays") {
    Asset asset = textured(ramp(64), odd_square());
    Part& part = asset.parts[0];
    part.triangles = {{3, 2, 1}, {2, 1, 3}, {3, 1, 0}, {0, 0, 1}};
    part.face_material.assign(4, 0);
    Options options{.target = ratio(1)};
    const SimplifiedAsset simplified = simplify(asset, options);
    const Part& result = simplified.asset.parts[0];
    CHECK(simplified.report.faces_dropped == 2);
    CHECK(simplified.report.untouched_parts.size() == 1);
    CHECK(result.triangles == std::vector<Triangle>{{3, 2, 1}, {3, 1, 0}});
    CHECK(result.face_material == std::vector<Index>{0, 0});
    CHECK(result.positions == part.positions);
    CHECK(result.uvs == part.uvs);
}

TEST_CASE("untouched: a part whose vertices are welded at a distance is baked") {
    Asset asset = textured(ramp(64), odd_square());
    Part& part = asset.parts[0];
    part.positions.push_back({1 + 1e-4, 1, 0});
    part.uvs[0].push_back({1, 0});
    part.uvs[1].push_back({1, 0});
    part.colors.push_back({1, 1, 1, 1});
    part.triangles[1] = {3, 4, 0};
    Options options{.target = ratio(1)};
    CHECK(simplify(asset, options).report.untouched_parts.size() == 1);
    options.topology.weld_distance = 1e-3;
    CHECK(simplify(asset, options).report.untouched_parts.empty());
}

TEST_CASE("untouched: every preset leaves a part with few faces as it is") {
    const Asset asset = textured(ramp(16), textured_sheet(4));
    const Options options{.target = faces(32), .preset = GENERATE(from_range(all_presets))};
    const SimplifiedAsset simplified = simplify(asset, options);
    CHECK(simplified.report.untouched_parts.size() == 1);
    CHECK(same_arrays(simplified.asset.parts[0], asset.parts[0]));
}

TEST_CASE("untouched: both stages decide as one call, and a restored history as the run") {
    const Asset asset = sheet_and_square();
    const Options options{.target = faces(100), .history = Recording::on};
    const SimplifiedAsset one_call = simplify(asset, options);
    const SimplifiedParts parts = simplify_parts(asset, options);
    SimplifiedParts restored;
    for (const CollapseHistory& history : one_call.histories) restored.parts.push_back(restore(history));
    for (const auto* simplified : std::array<const SimplifiedParts*, 2>{&parts, &restored}) {
        const SimplifiedAsset two = bake(asset, *simplified, options);
        CHECK(two.report.untouched_parts == one_call.report.untouched_parts);
        for (std::size_t p = 0; p < 2; ++p) CHECK(same_arrays(two.asset.parts[p], one_call.asset.parts[p]));
        REQUIRE(two.asset.images.size() == one_call.asset.images.size());
        for (std::size_t i = 0; i < two.asset.images.size(); ++i)
            CHECK(two.asset.images[i].encoded == one_call.asset.images[i].encoded);
    }
}

TEST_CASE("untouched: levels keep small parts; levels with a shared texture have a new atlas") {
    const Asset asset = sheet_and_square();
    const std::vector<Level> wanted = {ratio(1), faces(100), faces(30)};
    const auto levels = simplify_levels(asset, wanted, {}, LevelTextures::each);
    REQUIRE(levels.size() == 3);
    CHECK(levels[0].result.report.untouched_parts.size() == 2);
    for (const SimplifiedAssetLevel& level : levels) {
        CHECK(level.result.report.untouched_parts.back() == "part 'odd'");
        CHECK(level.result.asset.parts[1].uvs == asset.parts[1].uvs);
    }
    for (const SimplifiedAssetLevel& level : simplify_levels(asset, wanted, {}, LevelTextures::shared)) {
        CHECK(level.result.report.untouched_parts.empty());
        for (const Material& material : level.result.asset.materials) CHECK(material.rebaked);
    }
}
