#include "faqem/bake_levels.hpp"

#include <algorithm>
#include <cmath>

#include "faqem/compare.hpp"
#include "faqem/error.hpp"
#include "faqem/save_levels.hpp"
#include "support/catch.hpp"
#include "support/format_support.hpp"
#include "support/gltf_builder.hpp"
#include "support/scenes.hpp"

using namespace faqem;
using namespace faqem::test;

namespace {

Part rolling_sheet(Index n, double height, double x) {
    return sheet(n, [=](double u, double v) {
        return Vec3{x + u / n, v / n, height * std::sin(6 * u / n) * std::sin(5 * v / n)};
    });
}

Options plain() { return {.bake = {.kind = Bake::none}}; }

/// A sphere with a texture that is projected along z, so that red and green identify x and y.
Asset ball_painted_along_z() {
    Asset asset = textured_square(ramp(64));
    const auto uv_of = [](const Vec3& p) { return std::array{0.5 + p[0] / 2, 0.5 + p[1] / 2}; };
    asset.parts = {uv_mapped(part_of(icosphere(3)), uv_of)};
    return asset;
}

/// Mean difference of red and green between a level and the original at the same x and y.
double color_error(const SimplifiedAsset& simplified, const Asset& original) {
    const Asset& asset = simplified.asset;
    const Pixels before = decode(original.images[0]);
    const Part& part = asset.parts[0];
    double sum = 0, count = 0;
    for (std::size_t f = 0; f < part.triangles.size(); ++f) {
        const Material& material = asset.materials.at(part.face_material[f]);
        const Pixels image = decode(asset.images.at(material.base_color_texture.image));
        for (const Vec3& w : spread(3)) {
            const auto p = blend(part.positions, part.triangles[f], w);
            const auto is = look(part, image, f, w), was = read(before, 0.5 + p[0] / 2, 0.5 + p[1] / 2);
            for (const std::size_t k : {0, 1}) sum += std::abs(is[k] - was[k]), ++count;
        }
    }
    return sum / count;
}

const std::vector<Level> wanted_levels = {ratio(0.5), ratio(0.2), faces(60)};

}  // namespace

TEST_CASE("levels of an asset come from one run and the first is equal to that of simplify_parts") {
    Asset asset;
    asset.parts = {rolling_sheet(20, 0.2, 0), rolling_sheet(16, 0.05, 2), Part{}};
    for (const Budget budget : {Budget::scene, Budget::mesh}) {
        Options options = plain();
        options.budget = budget;
        const auto levels = simplify_parts_levels(asset, wanted_levels, options);
        REQUIRE(levels.size() == 3);
        const std::uint64_t most[] = {656, 262, 60};
        std::uint64_t last[] = {800, 512, 0};
        double error = 0;
        for (std::size_t i = 0; i < 3; ++i) {
            const SimplifiedParts& simplified = levels[i].result;
            CHECK(simplified.report.faces_out <= most[i]);
            CHECK(simplified.report.faces_out + 4 > most[i]);
            CHECK(levels[i].error >= error);
            error = levels[i].error;
            for (std::size_t p = 0; p < 3; ++p) {
                const TriangleMesh& mesh = simplified.parts[p].mesh;
                CHECK(mesh.triangles.size() <= last[p]);
                last[p] = mesh.triangles.size();
                if (p == 2) continue;
                const MeshView part{asset.parts[p].positions, asset.parts[p].triangles};
                CHECK(hausdorff(part, mesh.view()).value <= error);
            }
        }
        options.target = ratio(0.5);
        const SimplifiedParts alone = simplify_parts(asset, options);
        for (std::size_t p = 0; p < 3; ++p)
            CHECK(alone.parts[p].mesh.positions == levels[0].result.parts[p].mesh.positions);
    }
}

TEST_CASE("a level of an asset can be a distance in scene units") {
    Asset asset;
    asset.parts = {rolling_sheet(20, 0.2, 0), rolling_sheet(16, 0.05, 2)};
    const auto levels = simplify_parts_levels(asset, {ratio(0.5), model_units(0.02), faces(20)}, plain());
    REQUIRE(levels.size() == 3);
    REQUIRE(levels[1].result.report.max_error);
    CHECK(levels[1].result.report.max_error->within());
    CHECK(levels[1].error <= 0.02);
    CHECK(levels[2].error > 0.02);
}

TEST_CASE("every level of a textured asset has its own texture by default") {
    const Asset asset = textured(ramp(64), uv_mapped(rolling_sheet(12, 0.1, 0)));
    const Options options{.bake = {.texture_size = 64}};
    const auto levels = simplify_levels(asset, {ratio(0.5), ratio(0.1)}, options);
    REQUIRE(levels.size() == 2);
    for (const SimplifiedAssetLevel& level : levels) {
        CHECK_FALSE(level.result.asset.images.empty());
        CHECK(level.result.report.pages.size() == 1);
    }
    CHECK(levels[0].result.report.faces_out > levels[1].result.report.faces_out);
}

TEST_CASE("levels with a shared texture use one image and have the colours of the source") {
    const Asset ball = ball_painted_along_z();
    const Options options{.bake = {.texture_size = 128}};
    const std::vector<Level> goals = {ratio(0.5), ratio(0.25), of_diagonal(0.02), faces(80)};
    const auto levels = simplify_levels(ball, goals, options, LevelTextures::shared);
    REQUIRE(levels.size() == 4);
    CHECK(levels[0].result.report.pages.at(0).charts > 1);
    const std::size_t most[] = {640, 320, 320, 80};
    double error = 0;
    const MeshView original{ball.parts[0].positions, ball.parts[0].triangles};
    for (std::size_t i = 0; i < 4; ++i) {
        CAPTURE(i);
        const SimplifiedAsset& simplified = levels[i].result;
        const Part& part = simplified.asset.parts.at(0);
        CHECK(part.triangles.size() <= most[i]);
        CHECK(part.triangles.size() == simplified.report.faces_out);
        CHECK(simplified.report.faces_in == 1280);
        CHECK(simplified.report.vertices_in == levels[0].result.report.vertices_in);
        CHECK(simplified.report.pages.size() == (i == 0 ? 1 : 0));
        REQUIRE(simplified.asset.images.size() == 1);
        CHECK(simplified.asset.images[0].encoded == levels[0].result.asset.images[0].encoded);
        CHECK(color_error(simplified, ball) < 4);
        CHECK(levels[i].error >= error);
        error = levels[i].error;
        const MeshView view{part.positions, part.triangles};
        CHECK(hausdorff(original, view).value <= error);
    }
    REQUIRE(levels[2].result.report.max_error);
    CHECK(levels[2].result.report.max_error->within());
    CHECK(levels[2].result.report.max_error->runs == 1);  // no search
    CHECK(levels[3].result.report.collapses > levels[0].result.report.collapses);
}

TEST_CASE("a level with a smaller error bound than the finest level is equal to it") {
    const auto levels = simplify_levels(
        ball_painted_along_z(), {ratio(0.05), of_diagonal(0.0001), ratio(0.05)}, {}, LevelTextures::shared);
    REQUIRE(levels.size() == 3);
    CHECK(levels[0].error > 0);
    for (std::size_t i = 1; i < 3; ++i) {
        CHECK(levels[i].result.asset.parts[0].triangles.size() == levels[0].result.report.faces_out);
        CHECK(levels[i].error >= levels[0].error);
        CHECK(levels[i].error < 1.02 * levels[0].error);
    }
    CHECK_FALSE(levels[1].result.report.max_error->within());
}

TEST_CASE("options incompatible with a shared texture are rejected") {
    const Asset ball = ball_painted_along_z();
    const auto refused = [&](const Options& options) {
        CHECK_THROWS_AS(simplify_levels(ball, wanted_levels, options, LevelTextures::shared), OptionError);
    };
    for (const Bake kind : {Bake::per_triangle, Bake::vertex, Bake::keep, Bake::none})
        refused({.bake = {.kind = kind}});
    refused({.topology = {.group_boundaries = GroupBoundaries::preserved}});
    refused({.topology = {.weld = Weld::none}});
    refused({.history = Recording::on});
    CHECK(simplify_levels(ball, {}, {}, LevelTextures::shared).empty());
}

TEST_CASE("cancelled levels of an asset have the stop reason cancelled") {
    Asset asset;
    asset.parts = {rolling_sheet(40, 0.2, 0), rolling_sheet(40, 0.05, 2)};
    Options options = plain();
    options.threads = 1;  // with more threads the number of callbacks depends on the time that they take
    for (const LevelTextures textures : {LevelTextures::each, LevelTextures::shared}) {
        if (textures == LevelTextures::shared) options.bake.kind = Bake::atlas;
        std::size_t calls = 0;
        options.progress = [&](Phase, double) { return ++calls, Continue::yes; };
        simplify_levels(asset, wanted_levels, options, textures);
        for (const std::size_t stop : {std::size_t{0}, calls / 4, calls / 2, 3 * calls / 4, calls - 1}) {
            std::size_t before = 0;
            options.progress = [&](Phase, double) {
                return before++ == stop ? Continue::cancel : Continue::yes;
            };
            const auto levels = simplify_levels(asset, wanted_levels, options, textures);
            REQUIRE_FALSE(levels.empty());
            CHECK(levels.back().result.report.stop == StopReason::cancelled);
            CHECK(before == stop + 1);  // nothing is done afterwards
        }
    }
}

TEST_CASE("invalid levels of an asset are rejected") {
    Asset asset;
    asset.parts = {rolling_sheet(4, 0.2, 0)};
    CHECK_THROWS_AS(simplify_levels(asset, {ratio(0.1), ratio(0.5)}, plain()), OptionError);
    asset.parts[0].triangles[0][0] = 1000;
    CHECK_THROWS_AS(simplify_levels(asset, {ratio(0.1)}, plain()), InputError);
}

TEST_CASE("a scene with coarser levels gives what its finest level alone gives, with a warning") {
    const testing::TemporaryFolder folder;
    Asset one;
    one.parts = {rolling_sheet(12, 0.2, 0), rolling_sheet(8, 0.1, 2)};
    save(one, folder / "one.glb");
    one = load(folder / "one.glb");
    std::vector<SavedLevel> saved = {{one, {1, 1}}};
    for (SimplifiedAssetLevel& level : simplify_levels(one, {ratio(0.5), ratio(0.2)}, plain()))
        saved.push_back({std::move(level.result.asset), {0.5, 0.5}});
    save_levels(saved, folder / "chain.glb");
    const Asset chain = load(folder / "chain.glb");
    REQUIRE(chain.parts.size() == 6);
    const auto warns = [](const Report& report) {
        return std::count(report.warnings.begin(), report.warnings.end(),
                          "4 coarser levels of 2 nodes (MSFT_lod) left out: the finest one is simplified");
    };
    const auto check_equal = [&](const SimplifiedAsset& of_chain, const SimplifiedAsset& of_one) {
        CHECK(warns(of_chain.report) == 1);
        CHECK(of_chain.report.faces_in == of_one.report.faces_in);
        REQUIRE(of_chain.asset.parts.size() == 6);
        for (std::size_t p = 0; p < 2; ++p) {
            CHECK(of_chain.asset.parts[p].positions == of_one.asset.parts[p].positions);
            CHECK(of_chain.asset.parts[p].triangles == of_one.asset.parts[p].triangles);
        }
        for (std::size_t p = 2; p < 6; ++p) CHECK(of_chain.asset.parts[p].triangles.empty());
        save(of_chain.asset, folder / "a.glb", Overwrite::yes);
        CHECK(load(folder / "a.glb").parts.size() == 2);
    };
    Options options = plain();
    options.target = ratio(0.3);
    check_equal(simplify(chain, options), simplify(one, options));
    const SimplifiedParts parts = simplify_parts(chain, options);
    REQUIRE(parts.parts.size() == 6);
    check_equal(bake(chain, parts, options), bake(one, simplify_parts(one, options), options));
    for (const LevelTextures textures : {LevelTextures::each, LevelTextures::shared}) {
        const Options of_levels{.bake = {.texture_size = 64}};
        const auto levels = simplify_levels(chain, wanted_levels, of_levels, textures);
        const auto expected = simplify_levels(one, wanted_levels, of_levels, textures);
        REQUIRE(levels.size() == 3);
        for (std::size_t i = 0; i < 3; ++i) check_equal(levels[i].result, expected[i].result);
    }
}

TEST_CASE("save_levels computes the coverages at which the errors of levels have a size on screen") {
    std::vector<SimplifiedAssetLevel> levels(3);
    for (int i = 0; i < 3; ++i) {
        levels[i].result.asset = testing::load_glb(testing::square_gltf());
        levels[i].error = 0.5 * i;  // the first one is the original
    }
    const testing::TemporaryFolder folder;
    save_levels(levels, folder / "levels.glb", Overwrite::no, 0.1);
    const auto json = testing::json_of(testing::get(folder / "levels.glb"));
    const auto coverage = json["nodes"][0]["extras"]["MSFT_screencoverage"].get<std::vector<double>>();
    REQUIRE(coverage.size() == 3);  // a tenth of the height for 0.5 and for 1, of a diagonal of sqrt(2)
    CHECK_THAT(coverage[0], Catch::Matchers::WithinRel(0.2 * std::sqrt(2.0), 1e-6));
    CHECK_THAT(coverage[1], Catch::Matchers::WithinRel(0.1 * std::sqrt(2.0), 1e-6));
    CHECK(coverage[2] == 0);
    CHECK_THROWS_AS(save_levels(levels, folder / "other.glb", Overwrite::no, 0), OptionError);
    CHECK_THROWS_AS(save_levels(std::vector<SimplifiedAssetLevel>(), folder / "other.glb"), InputError);
}
