#include <algorithm>
#include <cstdio>
#include <string>

#include "faqem/bake.hpp"
#include "faqem/bake_levels.hpp"
#include "support/catch.hpp"
#include "support/format_support.hpp"
#include "support/scenes.hpp"
#include "support/torn_meshes.hpp"

using namespace faqem;
using namespace faqem::test;
using faqem::testing::any_contains;

namespace {

Asset asset_of(const TriangleMesh& mesh) {
    Asset asset = asset_with({part_of(mesh)});
    asset.parts[0].name = "ball";
    return asset;
}

Options tenth() { return {.target = ratio(0.1)}; }

const std::string by_rounding = "that differ from another one by rounding welded";

}  // namespace

TEST_CASE("files of torn soups are simplified as closed meshes") {
    const testing::TemporaryFolder folder;
    const std::string name = GENERATE("ball.stl", "ball.obj", "ball.ply", "ball.glb");
    save(asset_of(float_soup(moved(icosphere(3), {2, 2, 2}), 1)), folder / name);
    const Asset ball = load(folder / name);
    const SimplifiedParts simplified = simplify_parts(ball, tenth());
    CHECK(simplified.parts[0].mesh.triangles.size() <= 128);
    CHECK(closed_manifold(simplified.parts[0].mesh.triangles));
    CHECK(simplified.report.stop == StopReason::reached_target);
    CHECK(any_contains(simplified.report.warnings, by_rounding));
}

TEST_CASE("text with few decimal places is welded within these") {
    const testing::TemporaryFolder folder;
    std::string text;
    char line[100];
    const TriangleMesh ball = float_soup(moved(scaled(icosphere(3), 10), {300, 300, 300}), 0);
    Random random(3);
    for (const Vec3& p : ball.positions) {
        // Up to half a unit of the last place, before the rounding to it.
        const auto at = [&](std::size_t k) { return p[k] + random.between(-5e-5, 5e-5); };
        const double x = at(0), y = at(1), z = at(2);
        std::snprintf(line, sizeof line, "v %.4f %.4f %.4f\n", x, y, z);
        text += line;
    }
    for (const Triangle& t : ball.triangles)
        text += "f " + std::to_string(t[0] + 1) + " " + std::to_string(t[1] + 1) + " " +
                std::to_string(t[2] + 1) + "\n";
    testing::put(folder / "ball.obj", text);
    const SimplifiedParts simplified = simplify_parts(load(folder / "ball.obj"), tenth());
    CHECK(closed_manifold(simplified.parts[0].mesh.triangles));
}

TEST_CASE("other rules of welding do not tolerate rounding") {
    const Asset ball = asset_of(float_soup(icosphere(2), 1));
    Options options = tenth();
    SECTION("preset paper") { options.preset = Preset::paper, options.topology.weld_distance = 0; }
    SECTION("a distance") { options.topology.weld_distance = 0; }
    SECTION("none") { options.topology.weld = Weld::none; }
    const SimplifiedParts simplified = simplify_parts(ball, options);
    CHECK_FALSE(any_contains(simplified.report.warnings, by_rounding));
    CHECK(open_edges(simplified.parts[0].mesh) > 0);
}

TEST_CASE("arrays are welded where positions are equal") {
    const TriangleMesh torn = float_soup(icosphere(2), 1);
    CHECK(open_edges(simplify(torn.view(), tenth()).mesh) > 0);
}

TEST_CASE("levels of a torn soup are closed") {
    const Asset ball = asset_of(float_soup(icosphere(3), 1));
    Options options{.bake = {.kind = Bake::none}};
    const LevelTextures textures = GENERATE(LevelTextures::each, LevelTextures::shared);
    if (textures == LevelTextures::shared) options.bake.kind = Bake::automatic;
    const auto levels = simplify_levels(ball, {ratio(0.4), ratio(0.1)}, options, textures);
    REQUIRE(levels.size() == 2);
    for (const SimplifiedAssetLevel& level : levels) {
        const Part& part = level.result.asset.parts[0];
        CHECK(open_edges(make(part.positions, part.triangles)) == 0);
        CHECK(std::count_if(
                  level.result.report.warnings.begin(), level.result.report.warnings.end(),
                  [](const std::string& warning) { return testing::contains(warning, by_rounding); }) == 1);
    }
}

TEST_CASE("the error of a torn soup is measured from the closed mesh") {
    const Asset ball = asset_of(float_soup(icosphere(3), 1));
    Options options{.max_error = of_diagonal(0.02)};
    options.topology.prune = of_diagonal(0.5);  // each torn face would be a component that is pruned
    const SimplifiedParts simplified = simplify_parts(ball, options);
    CHECK(closed_manifold(simplified.parts[0].mesh.triangles));
    CHECK(simplified.report.components_pruned == 0);
    CHECK(simplified.report.max_error->bound <= 0.02 * 4);
}

TEST_CASE("a gap between the parts of a mesh is kept and reported") {
    TriangleMesh right = moved(grid(4), {4 * (1 + 1e-5), 0, 0});
    const Asset sheets = asset_of(both(grid(4), right));
    const SimplifiedParts simplified = simplify_parts(sheets, tenth());
    CHECK(any_contains(simplified.report.warnings, "part 'ball': 8 boundary edges have another one nearby"));
}
