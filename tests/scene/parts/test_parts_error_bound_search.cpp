#include <algorithm>
#include <cmath>

#include "faqem/compare.hpp"
#include "support/catch.hpp"
#include "support/scenes.hpp"

using namespace faqem;
using namespace faqem::test;

namespace {

// A wavy grid with 2 n^2 faces and waves of the given height, translated by `offset` along x.
Part wavy_grid(Index n, double height, double offset) {
    return sheet(n, [&](double i, double j) {
        const double x = i / n, y = j / n;
        return Vec3{x + offset, y, height * std::sin(9 * x) * std::cos(7 * y)};
    });
}

MeshView view(const Part& part) { return {part.positions, part.triangles, {}, nullptr, {}}; }

Options within(MaxError error) { return {.max_error = error, .bake = {.kind = Bake::none}}; }

}  // namespace

TEST_CASE("every part of an asset is within max_error and the report gives the distance") {
    Asset asset = asset_with({wavy_grid(20, 0.2, 0), wavy_grid(16, 0.05, 2), Part{}});
    const double allowed = 0.01;
    const SimplifiedParts simplified = simplify_parts(asset, within(model_units(allowed)));
    REQUIRE(simplified.parts.size() == 3);
    CHECK(simplified.report.stop == StopReason::reached_max_error);
    REQUIRE(simplified.report.max_error);
    const MeasuredError& error = *simplified.report.max_error;
    CHECK(error.within());
    CHECK(simplified.report.faces_out < simplified.report.faces_in / 2);
    CHECK(simplified.report.target_faces == simplified.report.faces_out);
    double value = 0, bound = 0;
    for (std::size_t p = 0; p < 2; ++p) {
        const DistanceBound own = hausdorff(view(asset.parts[p]), simplified.parts[p].mesh.view());
        value = std::max(value, own.value);
        bound = std::max(bound, own.bound);
        CHECK(simplified.parts[p].history.remaining_faces.size() ==
              simplified.parts[p].mesh.triangles.size());
    }
    // The report has the result of another search for the same distance. Both have an accuracy of 1%.
    CHECK(value <= allowed);
    CHECK(error.value <= bound);
    CHECK(error.bound >= value);
    CHECK(error.value >= allowed / 3);
}

TEST_CASE("max_error relative to the diagonal uses the diagonal of the scene") {
    Asset asset = asset_with({wavy_grid(16, 0.2, 0), wavy_grid(12, 0.05, 2)});
    Part all = asset.parts[0];
    for (Triangle t : asset.parts[1].triangles) {
        for (Index& v : t) v += static_cast<Index>(asset.parts[0].positions.size());
        all.triangles.push_back(t);
    }
    all.positions.insert(all.positions.end(), asset.parts[1].positions.begin(),
                         asset.parts[1].positions.end());
    const double diagonal = info(view(all)).diagonal;
    const SimplifiedParts share = simplify_parts(asset, within(of_diagonal(0.005)));
    const SimplifiedParts units = simplify_parts(asset, within(model_units(0.005 * diagonal)));
    CHECK(share.report.max_error->allowed == Approx(0.005 * diagonal));
    for (std::size_t p = 0; p < 2; ++p) {
        CHECK(share.parts[p].mesh.positions == units.parts[p].mesh.positions);
    }
}

TEST_CASE("the result for a target face count is checked against max_error") {
    Asset asset = asset_with({wavy_grid(16, 0.2, 0)});
    for (const double allowed : {1e-4, 1.0}) {
        Options options = within(model_units(allowed));
        options.target = faces(50);
        const SimplifiedAsset simplified = simplify(asset, options);
        CHECK(simplified.report.faces_out <= 50);
        CHECK(simplified.report.stop == StopReason::reached_target);
        REQUIRE(simplified.report.max_error);
        CHECK(simplified.report.max_error->runs == 1);
        CHECK(simplified.report.max_error->within() == (allowed == 1.0));
    }
}

TEST_CASE("the error bound search for an asset reports progress and can be cancelled") {
    Asset asset = asset_with({wavy_grid(32, 0.2, 0), wavy_grid(32, 0.1, 2)});
    Options options = within(of_diagonal(0.005));
    double last = 0;
    std::size_t calls = 0;
    options.progress = [&](Phase phase, double done) {
        if (phase != Phase::simplify) return Continue::yes;
        CHECK(done >= last);
        last = done;
        ++calls;
        return Continue::yes;
    };
    CHECK(!simplify(asset, options).asset.parts.empty());
    CHECK(last == 1);
    REQUIRE(calls > 3);
    const std::size_t stop = calls / 2;
    calls = 0;
    options.progress = [&](Phase, double) { return ++calls == stop ? Continue::cancel : Continue::yes; };
    const SimplifiedAsset simplified = simplify(asset, options);
    CHECK(simplified.report.stop == StopReason::cancelled);
    CHECK(simplified.asset.parts.empty());
    CHECK(calls == stop);
}
