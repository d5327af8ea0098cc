#include "faqem/detail/simplify/error_bound_search.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "faqem/compare.hpp"
#include "faqem/levels.hpp"
#include "support/brute_force.hpp"
#include "support/catch.hpp"
#include "support/meshes.hpp"

using namespace faqem;

namespace {

Options within(MaxError error, Preset preset = Preset::balanced) {
    return {.max_error = error, .preset = preset};
}

/// A flat square of side 1 with 2 n^2 faces, whose middle vertex is raised by `height`.
TriangleMesh bump(Index n, double height) {
    TriangleMesh mesh = test::square(n, 1, 0);
    mesh.positions[n / 2 + (n + 1) * (n / 2)][2] = height;
    return mesh;
}

double top(const TriangleMesh& mesh) {
    double z = 0;
    for (const Vec3& p : mesh.positions) z = std::max(z, p[2]);
    return z;
}

bool same_geometry(const TriangleMesh& a, const TriangleMesh& b) {
    return a.positions == b.positions && a.triangles == b.triangles;
}

/// Distance of a point from the surface of the unit cube.
double distance_from_cube(const Vec3& p) {
    double outside = 0, inside = std::numeric_limits<double>::infinity();
    for (const double x : p) {
        outside = std::hypot(outside, std::max({-x, 0.0, x - 1}));
        inside = std::min({inside, x, 1 - x});
    }
    return outside > 0 ? outside : inside;
}

bool warned(const Report& report, const std::string& beginning) {
    return std::any_of(report.warnings.begin(), report.warnings.end(),
                       [&](const std::string& w) { return w.rfind(beginning, 0) == 0; });
}

}  // namespace

TEST_CASE("an error search keeps a bump as high as max_error requires and simplifies the flat rest") {
    const double height = 0.05;
    const TriangleMesh mesh = bump(20, height);
    // Four faces over the whole square have an error of at least h / 2: smaller errors need more faces.
    const SimplifyResult close = simplify(mesh.view(), within(model_units(0.3 * height)));
    const SimplifyResult below = simplify(mesh.view(), within(model_units(0.98 * height)));
    const SimplifyResult above = simplify(mesh.view(), within(model_units(1.02 * height)));
    CHECK(top(close.mesh) >= 0.7 * height);
    CHECK(close.mesh.triangles.size() >= 5);
    CHECK(close.mesh.triangles.size() <= 40);
    CHECK(top(below.mesh) >= 0.02 * height);
    CHECK(above.mesh.triangles.size() <= 4);
    for (const SimplifyResult* result : {&close, &below, &above}) {
        const Report& report = result->report;
        CHECK(report.stop == StopReason::reached_max_error);
        REQUIRE(report.max_error);
        CHECK(report.max_error->within());
        CHECK(report.max_error->value <= report.max_error->bound);
        CHECK(report.max_error->bound <= report.max_error->value * 1.01 + 1e-8);
        CHECK(report.max_error->runs <= detail::FaceCountSearch::max_runs);
        CHECK(report.target_faces == report.faces_out);
        CHECK(report.faces_out == result->mesh.triangles.size());
    }
}

TEST_CASE("an error search with any preset gives a result within max_error") {
    const TriangleMesh mesh = test::shaken(test::icosphere(3), 0.004, 5);
    for (const Preset preset : all_presets) {
        CAPTURE(name(preset));
        const SimplifyResult result = simplify(mesh.view(), within(model_units(0.04), preset));
        REQUIRE(result.report.max_error);
        const MeasuredError& error = *result.report.max_error;
        CHECK(error.allowed == 0.04);
        CHECK(error.within());
        CHECK(std::max(test::sampled_distance(mesh, result.mesh, 4),
                       test::sampled_distance(result.mesh, mesh, 12)) <= error.bound + 1e-12);
        // The error of a sphere with n faces is about 2 / n at best: a few hundred of 1280 faces remain.
        CHECK(error.value >= 0.02);
        CHECK(result.mesh.triangles.size() <= 400);
        CHECK(result.mesh.triangles.size() >= 50);
    }
}

TEST_CASE("a place that reaches the error early does not keep faces elsewhere") {
    // Two spheres of 1280 faces; one of them has a spike, which cannot go.
    const TriangleMesh sphere = test::icosphere(3), other = test::moved(sphere, {5, 0, 0});
    TriangleMesh spiked = sphere;
    for (double& x : spiked.positions[0]) x *= 2;
    const TriangleMesh mesh = test::both(spiked, other);
    const SimplifyResult result = simplify(mesh.view(), within(model_units(0.04)));
    TriangleMesh left = result.mesh;
    std::erase_if(left.triangles, [&](const Triangle& t) { return left.positions[t[0]][0] <= 2.5; });
    // The error of a sphere with n faces is about 2 / n at best.
    CHECK(hausdorff(left.view(), other.view()).value >= 0.02);
    CHECK(hausdorff(left.view(), other.view()).value <= 0.04);
    CHECK(left.triangles.size() <= 200);
}

TEST_CASE("with max_error a terrain rough in one half has far fewer faces than with a number of faces") {
    TriangleMesh terrain = test::square(40, 1, 0);
    const TriangleMesh noise = test::shaken(terrain, 0.01, 3);
    for (std::size_t v = 0; v < terrain.positions.size(); ++v) {
        Vec3& p = terrain.positions[v];
        p[2] = 0.1 * std::sin(6 * p[0]) * std::cos(5 * p[1]) + (p[0] < 0.5 ? noise.positions[v][2] : 0);
    }
    for (const Preset preset : {Preset::fast, Preset::balanced, Preset::best}) {
        CAPTURE(name(preset));
        const SimplifyResult result = simplify(terrain.view(), within(model_units(0.005), preset));
        CHECK(result.report.max_error->within());
        CHECK(hausdorff(terrain.view(), result.mesh.view()).value <= 0.005);
        Options options{.target = faces(result.mesh.triangles.size() * 5 / 4)};
        CHECK(hausdorff(terrain.view(), simplify(terrain.view(), options).mesh.view()).value > 0.005);
    }
}

TEST_CASE("handles that are smaller than the error do not keep their faces") {
    TriangleMesh tori;  // each keeps at least 14 faces while it has its handle
    for (int i = 0; i < 6; ++i) tori = test::both(tori, test::moved(test::torus(16, 8), {10.0 * i, 0, 0}));
    const SimplifyResult result = simplify(tori.view(), {.max_error = model_units(1)});
    CHECK(result.report.max_error->within());
    CHECK(result.mesh.triangles.size() < 6 * 14);
}

TEST_CASE("faces that are too far are those of the result where one of the surfaces is") {
    const TriangleMesh flat = test::square(8, 1, 0), raised = bump(8, 0.1);
    const engine::RunContext& context = engine::RunContext::endless();
    const auto touch_the_bump = [&](const std::vector<detail::FarFaces>& far) {
        const auto touches = [&](Index f) {
            const Triangle& t = raised.triangles[f];
            return std::any_of(t.begin(), t.end(), [&](Index v) { return raised.positions[v][2] > 0; });
        };
        std::set<Index> faces;
        for (const auto& [face, original] : far) {
            CHECK((touches(face) && touches(original)));
            faces.insert(face);
        }
        return faces.size() == 6;
    };
    const detail::DistanceReference from_flat(flat.view()), from_raised(raised.view());
    CHECK(touch_the_bump(detail::FarFaceSearch(from_flat, 0.06)(raised.view(), context)));
    const std::vector<detail::FarFaces> below =
        detail::FarFaceSearch(from_raised, 0.06)(flat.view(), context);
    CHECK(touch_the_bump(below));
    CHECK(detail::FarFaceSearch(from_flat, 0.11)(raised.view(), context).empty());
    // After the first result only what changed is measured.
    detail::FarFaceSearch search(from_raised, 0.06);
    CHECK(search(raised.view(), context).empty());
    CHECK(search(flat.view(), context) == below);
    CHECK(search(flat.view(), context) == below);
    CHECK(search(raised.view(), context).empty());
}

TEST_CASE("results with clearly fewer faces than found by the error search exceed max_error") {
    const TriangleMesh mesh = test::icosphere(3);
    const SimplifyResult result = simplify(mesh.view(), within(model_units(0.02)));
    const auto found = static_cast<double>(result.mesh.triangles.size());
    for (const double share : {0.93, 0.85, 0.7, 0.5}) {
        Options options{.target = faces(static_cast<std::uint64_t>(share * found))};
        CHECK(hausdorff(mesh.view(), simplify(mesh.view(), options).mesh.view()).bound > 0.02);
    }
}

TEST_CASE("max_error of_diagonal is equivalent to max_error in model units") {
    const TriangleMesh mesh = test::scaled(test::torus(24, 16), 8);
    const double diagonal = info(mesh.view()).diagonal;
    const SimplifyResult share = simplify(mesh.view(), within(of_diagonal(0.01)));
    const SimplifyResult units = simplify(mesh.view(), within(model_units(0.01 * diagonal)));
    CHECK(share.mesh.triangles.size() < mesh.triangles.size() / 2);
    CHECK(same_geometry(share.mesh, units.mesh));
    CHECK(share.report.max_error->allowed == Approx(0.01 * diagonal));
}

TEST_CASE("with a target and max_error there is one run and one measurement") {
    const TriangleMesh mesh = test::icosphere(3);
    const Target target = GENERATE(faces(100), ratio(0.05));
    for (const double allowed : {1e-3, 0.5}) {
        Options options{.target = target};
        const SimplifyResult plain = simplify(mesh.view(), options);
        CHECK(!plain.report.max_error);
        options.max_error = model_units(allowed);
        const SimplifyResult result = simplify(mesh.view(), options);
        CHECK(same_geometry(result.mesh, plain.mesh));
        CHECK(result.report.stop == StopReason::reached_target);
        CHECK(result.report.target_faces == plain.report.target_faces);
        REQUIRE(result.report.max_error);
        const DistanceBound measured = hausdorff(mesh.view(), plain.mesh.view());
        CHECK(result.report.max_error->value == measured.value);
        CHECK(result.report.max_error->bound == measured.bound);
        CHECK(result.report.max_error->within() == (allowed == 0.5));
        CHECK(result.report.max_error->runs == 1);
    }
}

TEST_CASE("the distances reported for a simplified cube include those of its vertices") {
    // The fitting of preset best moves vertices outside the cube, with 6 faces farther than any point of the cube
    // is from the result.
    const TriangleMesh cube = test::cube();
    const Preset preset = GENERATE(Preset::best, Preset::balanced, Preset::qem);
    for (const std::uint64_t target : {4, 6, 8, 10, 12}) {
        CAPTURE(target);
        Options options = within(model_units(1), preset);
        const std::vector<SimplifiedLevel> level =
            simplify_levels(cube.view(), {faces(target)}, {.preset = preset});
        options.target = faces(target);
        const SimplifyResult result = simplify(cube.view(), options);
        for (const Vec3& p : result.mesh.positions) {
            CHECK(distance_from_cube(p) <= result.report.max_error->value * (1 + 1e-12));
            CHECK(distance_from_cube(p) <= level[0].error * (1 + 1e-12));
        }
        CHECK(same_geometry(result.mesh, level[0].result.mesh));
    }
}

TEST_CASE("a max_error too small for any collapse gives the input as the result") {
    const TriangleMesh mesh = test::shaken(test::grid(6), 0.1, 2);
    for (const double allowed : {1e-9, 1e-300}) {
        const SimplifyResult result = simplify(mesh.view(), within(model_units(allowed)));
        CHECK(same_geometry(result.mesh, mesh));
        CHECK(result.report.stop == StopReason::reached_max_error);
        CHECK(result.report.max_error->bound == 0);
        CHECK(result.report.max_error->within());
        CHECK(warned(result.report, "no smaller mesh within max_error was found"));
    }
}

TEST_CASE("a max_error larger than the model gives the smallest possible mesh") {
    const TriangleMesh mesh = test::icosphere(2);
    const SimplifyResult result = simplify(mesh.view(), within(of_diagonal(10)));
    CHECK(result.mesh.triangles.size() <= 4);
    CHECK(!result.mesh.triangles.empty());
    CHECK(result.report.max_error->runs <= 3);
}

TEST_CASE("locked boundaries and vertices are kept with any max_error") {
    const TriangleMesh mesh = test::cylinder(12, 8, 4);
    Options options = within(model_units(100));
    options.topology.boundary = Boundary::locked;
    const SimplifyResult result = simplify(mesh.view(), options);
    CHECK(result.mesh.triangles.size() >= 24);
    CHECK(result.report.stop == StopReason::reached_max_error);
    std::vector<std::uint8_t> all(mesh.positions.size(), 1);
    MeshView view{.positions = mesh.positions, .triangles = mesh.triangles, .vertex_locks = all};
    CHECK(same_geometry(simplify(view, options).mesh, mesh));
}

TEST_CASE("an error search reports if welding alone exceeds max_error") {
    const TriangleMesh mesh = bump(8, 0.3);
    Options options = within(model_units(1e-3));
    options.topology.weld_distance = 0.5;
    const SimplifyResult result = simplify(mesh.view(), options);
    REQUIRE(result.report.max_error);
    CHECK(!result.report.max_error->within());
    CHECK(result.report.max_error->value > 1e-3);
    CHECK(result.report.stop != StopReason::reached_max_error);
    CHECK(warned(result.report, "no mesh within max_error was found"));
}

TEST_CASE("the distance is zero for originals without area and infinite if only the result has none") {
    const Options options = within(of_diagonal(0.01));
    const SimplifyResult empty = simplify(MeshView{}, options);
    CHECK(empty.mesh.triangles.empty());
    CHECK(empty.report.max_error->within());
    TriangleMesh line = test::grid(4);
    for (Vec3& p : line.positions) p[1] = p[2] = 0;
    const SimplifyResult flat = simplify(line.view(), options);
    CHECK(flat.report.max_error->bound == 0);
    // Only the result has no area.
    SimplifyResult no_faces;
    no_faces.report.collapses = 1;
    const detail::DistanceReference original(test::cube().view());
    CHECK(detail::distance(original, no_faces, 1, detail::MeasureMode::full, {}).bound ==
          std::numeric_limits<double>::infinity());
}

TEST_CASE("an error search does not depend on the number of threads and its history gives the result") {
    const TriangleMesh mesh = test::shaken(test::torus(32, 24), 0.01, 1);
    Options options = within(of_diagonal(0.01));
    options.history = Recording::on;
    options.threads = 1;
    const SimplifyResult one = simplify(mesh.view(), options);
    CHECK(same_geometry(replay(one.history), one.mesh));
    options.threads = 3;
    const SimplifyResult three = simplify(mesh.view(), options);
    CHECK(same_geometry(one.mesh, three.mesh));
    CHECK(one.report.max_error->value == three.report.max_error->value);
    CHECK(one.report.max_error->bound == three.report.max_error->bound);
    CHECK(one.report.max_error->runs == three.report.max_error->runs);
}

TEST_CASE("progress of an error search increases to 1 and any call can cancel it") {
    const TriangleMesh mesh = test::torus(48, 32);
    Options options = within(of_diagonal(0.005));
    options.threads = 1;  // the number of calls while waiting for other threads depends on time
    std::vector<double> seen;
    options.progress = [&](Phase phase, double done) {
        CHECK(phase == Phase::simplify);
        seen.push_back(done);
        return Continue::yes;
    };
    simplify(mesh.view(), options);
    REQUIRE(seen.size() > 4);
    CHECK(std::is_sorted(seen.begin(), seen.end()));
    CHECK(seen.front() >= 0);
    CHECK(seen.back() == 1);
    for (const std::size_t last : {std::size_t{0}, seen.size() / 2, seen.size() - 2, seen.size() - 1}) {
        std::size_t calls = 0;
        options.progress = [&](Phase, double) { return calls++ == last ? Continue::cancel : Continue::yes; };
        const SimplifyResult result = simplify(mesh.view(), options);
        CHECK(result.report.stop == StopReason::cancelled);
        CHECK(!result.report.max_error);
        CHECK(calls == last + 1);
    }
}
