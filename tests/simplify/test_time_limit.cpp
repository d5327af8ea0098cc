#include <cstdint>
#include <limits>
#include <vector>

#include "faqem/detail/options/option_table.hpp"
#include "faqem/detail/simplify/run.hpp"
#include "faqem/error.hpp"
#include "faqem/levels.hpp"
#include "faqem/simplify.hpp"
#include "support/catch.hpp"
#include "support/meshes.hpp"

using namespace faqem;

namespace {

constexpr double no_time = 1e-9;  // over at the first check

TriangleMesh bumpy_sphere() { return test::shaken(test::icosphere(4), 0.003, 1); }

bool is_same(const SimplifyResult& a, const SimplifyResult& b) {
    return a.mesh.positions == b.mesh.positions && a.mesh.triangles == b.mesh.triangles &&
           a.face_origin == b.face_origin && a.report.stop == b.report.stop &&
           a.report.warnings == b.report.warnings && a.history.collapses.size() == b.history.collapses.size();
}

}  // namespace

TEST_CASE("a time limit that is over at once gives the input with stop reason reached_time_limit") {
    const TriangleMesh mesh = bumpy_sphere();
    for (const Preset preset : all_presets) {
        CAPTURE(name(preset));
        const SimplifyResult result =
            simplify(mesh.view(), {.target = ratio(0.1), .max_seconds = no_time, .preset = preset});
        CHECK(result.report.stop == StopReason::reached_time_limit);
        CHECK(name(result.report.stop) == "reached_time_limit");
        CHECK(result.mesh.triangles.size() == mesh.triangles.size());
        CHECK(result.report.faces_out == mesh.triangles.size());
        CHECK(result.report.target_faces == mesh.triangles.size() / 10);
        CHECK(result.report.collapses == 0);
    }
}

TEST_CASE("targets that follow one without time give the input as well") {
    const TriangleMesh mesh = bumpy_sphere();
    const std::size_t faces_in = mesh.triangles.size();
    const std::vector<std::uint64_t> targets = {faces_in, faces_in / 2, faces_in / 4};
    for (const Preset preset : all_presets) {
        CAPTURE(name(preset));
        const Options options{.max_seconds = no_time, .preset = preset};
        const std::vector<SimplifyResult> results =
            detail::run_to_targets(mesh.view(), targets, options, engine::RunContext(options));
        REQUIRE(results.size() == 3);
        CHECK(results[0].report.stop == StopReason::reached_target);
        for (std::size_t i = 0; i < results.size(); ++i) {
            CHECK(results[i].mesh.triangles.size() == faces_in);
            if (i > 0) CHECK(results[i].report.stop == StopReason::reached_time_limit);
        }
    }
}

TEST_CASE("a target that needs no collapse is reached without time") {
    const TriangleMesh mesh = bumpy_sphere();
    const SimplifyResult result =
        simplify(mesh.view(), {.target = faces(mesh.triangles.size()), .max_seconds = no_time});
    CHECK(result.report.stop == StopReason::reached_target);
}

TEST_CASE("a time limit that is never reached does not change the result") {
    const TriangleMesh mesh = bumpy_sphere();
    for (const double large : {1e8, 1e300}) {
        for (const Preset preset : all_presets) {
            CAPTURE(name(preset), large);
            Options options{.target = ratio(0.1), .preset = preset, .history = Recording::on};
            const SimplifyResult without = simplify(mesh.view(), options);
            options.max_seconds = large;
            CHECK(is_same(simplify(mesh.view(), options), without));
        }
        Options within{.max_error = of_diagonal(0.01)};
        const SimplifyResult without = simplify(mesh.view(), within);
        within.max_seconds = large;
        CHECK(is_same(simplify(mesh.view(), within), without));
    }
}

TEST_CASE("a search within an error that has no time gives a result within the error") {
    const TriangleMesh mesh = bumpy_sphere();
    const SimplifyResult searched =
        simplify(mesh.view(), {.max_error = of_diagonal(0.01), .max_seconds = no_time});
    CHECK(searched.report.stop == StopReason::reached_time_limit);
    CHECK(searched.mesh.triangles.size() == mesh.triangles.size());
    REQUIRE(searched.report.max_error);
    CHECK(searched.report.max_error->within());
    const SimplifyResult once =
        simplify(mesh.view(), {.target = ratio(0.1), .max_error = of_diagonal(0.01), .max_seconds = no_time});
    CHECK(once.report.stop == StopReason::reached_time_limit);
    CHECK(once.report.max_error->within());
}

TEST_CASE("a large mesh is not split into blocks after the time limit") {
    const TriangleMesh mesh = test::icosphere(6);
    const SimplifyResult result =
        simplify(mesh.view(), {.target = ratio(0.01), .max_seconds = no_time, .history = Recording::on});
    CHECK(result.report.stop == StopReason::reached_time_limit);
    CHECK(result.mesh.triangles.size() == mesh.triangles.size());
    CHECK(result.history.collapses.empty());
}

TEST_CASE("max_seconds must be finite and positive, and unset for levels") {
    const TriangleMesh mesh = test::icosphere(1);
    for (const double bad : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN(), test::infinity})
        CHECK_THROWS_WITH(simplify(mesh.view(), {.max_seconds = bad}),
                          "max_seconds must be finite and > 0, not " + detail::number_text(bad));
    CHECK_THROWS_AS(simplify_levels(mesh.view(), {ratio(0.5)}, {.max_seconds = 1}), OptionError);
}
