#include "scene/position_grids.hpp"

#include <cmath>

#include "faqem/bake_levels.hpp"
#include "faqem/compare.hpp"
#include "faqem/error.hpp"
#include "support/catch.hpp"
#include "support/format_support.hpp"
#include "support/scenes.hpp"

using namespace faqem;
using namespace faqem::test;

namespace {

// Two wavy grids of 2 n^2 faces side by side; the diagonal of the scene is a little above 2.2.
Asset two_sheets(Index n) {
    Asset asset;
    for (const double offset : {0.0, 1.0})
        asset.parts.push_back(sheet(n, [&](double i, double j) {
            const double x = i / n + offset, y = j / n;
            return Vec3{x, y, 0.1 * std::sin(9 * x) * std::cos(7 * y)};
        }));
    return asset;
}

Options quantized(std::uint32_t bits) {
    return {.bake = {.kind = Bake::none}, .quantize = {.kind = Quantize::on, .position_bits = bits}};
}

}  // namespace

TEST_CASE("all parts and levels have the grid of the scene, a power of two") {
    const Asset asset = two_sheets(12);
    const auto levels = simplify_levels(asset, {ratio(0.5), ratio(0.1)}, quantized(10));
    REQUIRE(levels.size() == 2);
    for (const SimplifiedAssetLevel& level : levels) {
        // 2.2 / 2^10, rounded up
        for (const Part& part : level.result.asset.parts) CHECK(part.position_spacing == 0x1p-8);
        REQUIRE(level.result.report.position_rounding);
        CHECK(level.result.report.position_rounding->spacing == 0x1p-8);
        const double moved = level.result.report.position_rounding->max_error;
        CHECK(moved > 0);
        CHECK(moved <= 0x1p-9 * std::sqrt(3.0));
        CHECK(level.result.asset.normal_bits == 10);
    }
}

TEST_CASE("a source of floats has no grid by default, and none without quantisation") {
    Options options = quantized(10);
    for (const Quantize kind : {Quantize::source, Quantize::off}) {
        options.quantize.kind = kind;
        const SimplifiedAsset result = simplify(two_sheets(6), options);
        CHECK(result.asset.parts[0].position_spacing == 0);
        CHECK(result.asset.normal_bits == 0);
        CHECK_FALSE(result.report.position_rounding);
    }
}

TEST_CASE("the grid of the source is kept, unless it is coarse for max_error") {
    Asset asset = two_sheets(8);
    for (Part& part : asset.parts) part.position_spacing = 0x1p-9;
    Options options{.bake = {.kind = Bake::none}};
    CHECK(simplify(asset, options).asset.parts[1].position_spacing == 0x1p-9);
    options.max_error = model_units(0.1);
    CHECK(simplify(asset, options).asset.parts[1].position_spacing == 0x1p-9);
    options.max_error = model_units(0x1p-9);
    const SimplifiedAsset fine = simplify(asset, options);
    CHECK(fine.asset.parts[1].position_spacing == 0);
    CHECK(testing::any_contains(fine.report.warnings, "coarse for max_error"));
}

TEST_CASE("max_error includes the rounding of positions") {
    const Asset asset = two_sheets(16);
    Options options = quantized(8);  // a spacing of 1/64
    options.max_error = model_units(0.04);
    const SimplifiedAsset result = simplify(asset, options);
    REQUIRE(result.report.max_error);
    CHECK(result.report.max_error->within());
    CHECK(result.report.max_error->allowed == 0.04);
    CHECK(result.report.max_error->bound >= std::sqrt(3.0) / 128);
    for (std::size_t p = 0; p < 2; ++p) {
        Part rounded = result.asset.parts[p];
        for (Vec3& position : rounded.positions)
            for (double& x : position) x = std::round(x * 64) / 64;
        const Part& original = asset.parts[p];
        const DistanceBound distance = hausdorff({original.positions, original.triangles, {}, nullptr, {}},
                                                 {rounded.positions, rounded.triangles, {}, nullptr, {}});
        CHECK(distance.value <= 0.04);
    }
    options.max_error = model_units(0.01);
    CHECK_THROWS_AS(simplify(asset, options), OptionError);
}
