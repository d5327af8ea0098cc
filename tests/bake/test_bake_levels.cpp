#include "faqem/bake_levels.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "bake/scenes.hpp"
#include "faqem/compare.hpp"
#include "faqem/error.hpp"

using namespace faqem;
using namespace faqem::test;

namespace {

Part waves(Index n, double height, double x) {
    return sheet(n, [=](double u, double v) {
        return Vec3{x + u / n, v / n, height * std::sin(6 * u / n) * std::sin(5 * v / n)};
    });
}

Options plain() {
    Options options;
    options.bake.kind = Bake::none;
    return options;
}

const std::vector<Level> wanted = {ratio(0.5), ratio(0.2), faces(60)};

}  // namespace

TEST_CASE("the levels of an asset share one run, and the first is what simplify gives") {
    Asset asset;
    asset.parts = {waves(20, 0.2, 0), waves(16, 0.05, 2), Part{}};
    for (const Budget budget : {Budget::scene, Budget::mesh}) {
        Options options = plain();
        options.budget = budget;
        const auto levels = simplify_parts_levels(asset, wanted, options);
        REQUIRE(levels.size() == 3);
        const std::uint64_t most[] = {656, 262, 60};
        std::uint64_t last[] = {800, 512, 0};
        double error = 0;
        for (std::size_t i = 0; i < 3; ++i) {
            const SmallParts& small = levels[i].result;
            CHECK(small.report.faces_out <= most[i]);
            CHECK(small.report.faces_out + 4 > most[i]);
            CHECK(levels[i].error >= error);
            error = levels[i].error;
            for (std::size_t p = 0; p < 3; ++p) {
                const TriangleMesh& mesh = small.parts[p].mesh;
                CHECK(mesh.triangles.size() <= last[p]);
                last[p] = mesh.triangles.size();
                if (p == 2) continue;
                const MeshView part{asset.parts[p].positions, asset.parts[p].triangles};
                CHECK(hausdorff(part, mesh.view()).value <= error);
            }
        }
        options.target = ratio(0.5);
        const SmallParts alone = simplify_parts(asset, options);
        for (std::size_t p = 0; p < 3; ++p)
            CHECK(alone.parts[p].mesh.positions == levels[0].result.parts[p].mesh.positions);
    }
}

TEST_CASE("an asset's level may be a distance in the units of the scene") {
    Asset asset;
    asset.parts = {waves(20, 0.2, 0), waves(16, 0.05, 2)};
    const auto levels = simplify_parts_levels(asset, {ratio(0.5), model_units(0.02), faces(20)}, plain());
    REQUIRE(levels.size() == 3);
    REQUIRE(levels[1].result.report.max_error);
    CHECK(levels[1].result.report.max_error->within());
    CHECK(levels[1].error <= 0.02);
    CHECK(levels[2].error > 0.02);
}

TEST_CASE("every level of a textured asset has a texture of its own") {
    Asset asset = textured_square(ramp(64));
    asset.parts[0] = waves(12, 0.1, 0);
    asset.parts[0].face_material.assign(asset.parts[0].triangles.size(), 0);
    asset.parts[0].uvs.resize(1);
    for (const Vec3& p : asset.parts[0].positions)
        asset.parts[0].uvs[0].push_back({static_cast<float>(p[0]), static_cast<float>(1 - p[1])});
    Options options;
    options.bake.texture_size = 64;
    const auto levels = simplify_levels(asset, {ratio(0.5), ratio(0.1)}, options);
    REQUIRE(levels.size() == 2);
    for (const LightLevel& level : levels) {
        CHECK(level.result.asset.images.size() >= 1);
        CHECK(level.result.report.pages.size() == 1);
    }
    CHECK(levels[0].result.report.faces_out > levels[1].result.report.faces_out);
}

TEST_CASE("cancelling the levels of an asset says so") {
    Asset asset;
    asset.parts = {waves(40, 0.2, 0), waves(40, 0.05, 2)};
    Options options = plain();
    options.threads = 1;  // who waits for other threads asks every few milliseconds, as often as that takes
    std::size_t calls = 0;
    options.progress = [&](Phase, double) { return ++calls, Continue::yes; };
    simplify_levels(asset, wanted, options);
    for (const std::size_t stop : {std::size_t{0}, calls / 4, calls / 2, calls - 1}) {
        std::size_t left = stop;
        options.progress = [&](Phase, double) { return left-- > 0 ? Continue::yes : Continue::cancel; };
        const auto levels = simplify_levels(asset, wanted, options);
        REQUIRE_FALSE(levels.empty());
        CHECK(levels.back().result.report.stop == StopReason::cancelled);
    }
}

TEST_CASE("levels of an asset are checked like those of a mesh") {
    Asset asset;
    asset.parts = {waves(4, 0.2, 0)};
    CHECK_THROWS_AS(simplify_levels(asset, {ratio(0.1), ratio(0.5)}, plain()), OptionError);
    asset.parts[0].triangles[0][0] = 1000;
    CHECK_THROWS_AS(simplify_levels(asset, {ratio(0.1)}, plain()), InputError);
}
