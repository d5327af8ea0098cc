#include "faqem/levels.hpp"

#include <algorithm>
#include <limits>

#include "faqem/compare.hpp"
#include "faqem/error.hpp"
#include "support/catch.hpp"
#include "support/meshes.hpp"

using namespace faqem;

namespace {

Options with(Preset preset, Recording history = Recording::off) {
    return {.preset = preset, .history = history};
}

void check_same_level(const SimplifyResult& a, const SimplifyResult& b) {
    CHECK(a.mesh.positions == b.mesh.positions);
    CHECK(a.mesh.triangles == b.mesh.triangles);
    CHECK(a.mesh.attributes.values == b.mesh.attributes.values);
    CHECK(a.vertex_origin == b.vertex_origin);
    CHECK(a.face_origin == b.face_origin);
    CHECK(a.report.collapses == b.report.collapses);
    CHECK(a.report.refusals == b.report.refusals);
    CHECK(a.history.remaining_versions == b.history.remaining_versions);
    CHECK(a.history.patch_faces == b.history.patch_faces);
}

}  // namespace

TEST_CASE("levels: a single level equals the result of simplify()") {
    const TriangleMesh mesh = test::lump(4);
    for (const Preset preset : all_presets) {
        Options options = with(preset, Recording::on);
        const std::vector<SimplifiedLevel> levels = simplify_levels(mesh.view(), {ratio(0.1)}, options);
        REQUIRE(levels.size() == 1);
        options.target = ratio(0.1);
        check_same_level(levels[0].result, simplify(mesh.view(), options));
    }
}

TEST_CASE("levels: with accumulated quadrics, each level equals a separate run") {
    const TriangleMesh mesh = test::lump(4);
    for (const Preset preset : {Preset::qem, Preset::paper, Preset::stmw}) {
        Options options = with(preset, Recording::on);
        const auto levels = simplify_levels(mesh.view(), {ratio(0.5), faces(1000), ratio(0.05)}, options);
        REQUIRE(levels.size() == 3);
        const Target targets[] = {ratio(0.5), faces(1000), ratio(0.05)};
        for (std::size_t i = 0; i < 3; ++i) {
            options.target = targets[i];
            check_same_level(levels[i].result, simplify(mesh.view(), options));
        }
    }
}

TEST_CASE("levels: each level reaches its face count, and errors are valid bounds and do not decrease") {
    const TriangleMesh mesh = test::lump(4);
    const std::vector<Level> wanted = {ratio(0.5), ratio(0.25), ratio(0.1), faces(100), faces(20)};
    for (const Preset preset : {Preset::fast, Preset::balanced, Preset::best, Preset::qem}) {
        const auto levels = simplify_levels(mesh.view(), wanted, with(preset));
        REQUIRE(levels.size() == wanted.size());
        const std::size_t face_counts[] = {2560, 1280, 512, 100, 20};
        double last = 0;
        for (std::size_t i = 0; i < levels.size(); ++i) {
            const SimplifyResult& result = levels[i].result;
            CHECK(result.report.stop == StopReason::reached_target);
            CHECK(result.report.target_faces == face_counts[i]);
            CHECK(result.mesh.triangles.size() <= face_counts[i]);
            CHECK(result.mesh.triangles.size() + 2 > face_counts[i]);
            CHECK(result.report.faces_in == mesh.triangles.size());
            CHECK(result.report.faces_out == result.mesh.triangles.size());
            CHECK(levels[i].error >= last);
            CHECK(levels[i].distance <= levels[i].error);
            CHECK(hausdorff(mesh.view(), result.mesh.view()).value <= levels[i].error);
            CHECK_FALSE(result.report.max_error);
            last = levels[i].error;
        }
    }
}

TEST_CASE("levels: the history of each level starts at the original and replays to its mesh") {
    const TriangleMesh mesh = test::lump(4);
    for (const Preset preset : {Preset::balanced, Preset::best, Preset::qem}) {
        const auto levels =
            simplify_levels(mesh.view(), {ratio(0.5), ratio(0.2), ratio(0.04)}, with(preset, Recording::on));
        for (const SimplifiedLevel& level : levels) {
            const CollapseHistory& history = level.result.history;
            CHECK_NOTHROW(validate(history));
            CHECK(history.collapses.size() == level.result.report.collapses);
            const TriangleMesh again = replay(history);
            CHECK(again.positions == level.result.mesh.positions);
            CHECK(again.triangles == level.result.mesh.triangles);
        }
        const auto& first = levels.front().result.history.collapses;
        const auto& last = levels.back().result.history.collapses;
        REQUIRE(first.size() < last.size());
        for (std::size_t i = 0; i < first.size(); ++i) {
            CHECK(first[i].first == last[i].first);
            CHECK(first[i].second == last[i].second);
        }
    }
}

TEST_CASE("levels: results do not depend on recording, number of threads or later levels") {
    const TriangleMesh mesh = test::lump(6);  // 40962 vertices: simplified in blocks
    const auto all = simplify_levels(mesh.view(), {ratio(0.5), ratio(0.1)}, with(Preset::balanced));
    Options other = with(Preset::balanced, Recording::on);
    other.threads = 1;
    const auto first = simplify_levels(mesh.view(), {ratio(0.5)}, other);
    const auto both = simplify_levels(mesh.view(), {ratio(0.5), ratio(0.1)}, other);
    CHECK(all[0].result.mesh.positions == first[0].result.mesh.positions);
    for (std::size_t i = 0; i < 2; ++i) {
        CHECK(all[i].result.mesh.positions == both[i].result.mesh.positions);
        CHECK(all[i].result.mesh.triangles == both[i].result.mesh.triangles);
        CHECK(all[i].error == both[i].error);
        CHECK_NOTHROW(validate(both[i].result.history));
        CHECK(replay(both[i].result.history).positions == both[i].result.mesh.positions);
    }
}

TEST_CASE("levels: vertex fitting of one level does not affect the next one") {
    const TriangleMesh mesh = test::lump(4);
    const std::vector<Level> wanted = {ratio(0.3), ratio(0.1), ratio(0.02)};
    const auto unfitted = simplify_levels(mesh.view(), wanted, with(Preset::balanced));
    const auto fitted = simplify_levels(mesh.view(), wanted, with(Preset::best, Recording::on));
    for (std::size_t i = 0; i < wanted.size(); ++i) {
        CHECK(fitted[i].result.report.vertices_fitted > 0);
        CHECK(fitted[i].result.face_origin == unfitted[i].result.face_origin);
        for (std::size_t v = 0; v < unfitted[i].result.mesh.positions.size(); ++v) {
            const Index version = fitted[i].result.history.remaining_versions[v];
            CHECK(fitted[i].result.history.position(version) == unfitted[i].result.mesh.positions[v]);
        }
    }
}

TEST_CASE("levels: attributes, groups and vertex weights are kept in all levels") {
    TriangleMesh mesh = test::lump(4);
    mesh.attributes.width = 2;
    for (const Triangle& t : mesh.triangles) {
        mesh.face_groups.push_back(mesh.positions[t[0]][2] > 0 ? 1 : 0);
        for (const Index v : t) {
            for (const std::size_t i : {0u, 1u})
                mesh.attributes.values.push_back(static_cast<float>(mesh.positions[v][i]));
        }
    }
    std::vector<float> weights(mesh.positions.size(), 1);
    weights[0] = 100;
    MeshView view = mesh.view();
    view.vertex_weights = weights;
    for (const Preset preset : {Preset::fast, Preset::balanced}) {
        Options options = with(preset, Recording::on);
        options.topology.group_boundaries = GroupBoundaries::preserved;
        const auto levels = simplify_levels(view, {ratio(0.5), ratio(0.2)}, options);
        for (const SimplifiedLevel& level : levels) {
            const TriangleMesh& out = level.result.mesh;
            CHECK(level.result.report.stop == StopReason::reached_target);
            CHECK(out.attributes.values.size() == 6 * out.triangles.size());
            CHECK(out.face_groups.size() == out.triangles.size());
            CHECK_NOTHROW(validate(level.result.history));
        }
        options.target = ratio(0.5);
        CHECK(levels[0].result.mesh.positions == simplify(view, options).mesh.positions);
    }
}

TEST_CASE("levels: locked vertices are kept in all levels") {
    const TriangleMesh mesh = test::lump(4);
    std::vector<std::uint8_t> locks(mesh.positions.size(), 0);
    for (std::size_t v = 0; v < 10; ++v) locks[50 * v] = 1;
    MeshView view = mesh.view();
    view.vertex_locks = locks;
    for (const SimplifiedLevel& level : simplify_levels(view, {ratio(0.5), ratio(0.2), ratio(0.05)})) {
        const auto& out = level.result.mesh.positions;
        for (std::size_t v = 0; v < locks.size(); ++v) {
            if (locks[v]) CHECK(std::count(out.begin(), out.end(), mesh.positions[v]) == 1);
        }
    }
}

TEST_CASE("levels: distances and face counts may be mixed") {
    const TriangleMesh mesh = test::lump(4);
    const std::vector<Level> wanted = {ratio(0.5), model_units(0.03), faces(60), of_diagonal(0.1)};
    const auto levels = simplify_levels(mesh.view(), wanted, with(Preset::fast));
    REQUIRE(levels.size() == 4);
    for (const std::size_t i : {1u, 3u}) {
        const SimplifyResult& result = levels[i].result;
        CHECK(result.report.stop == StopReason::reached_max_error);
        REQUIRE(result.report.max_error);
        CHECK(result.report.max_error->within());
        CHECK(levels[i].error <= result.report.max_error->allowed);
        CHECK(result.mesh.triangles.size() < levels[i - 1].result.mesh.triangles.size());
    }
    CHECK(levels[1].result.report.max_error->allowed == 0.03);
    CHECK(levels[2].result.mesh.triangles.size() <= 60);
    CHECK(levels[2].error > 0.03);
}

TEST_CASE("levels: a level of a distance equals the result of simplify() within it, after any others") {
    const TriangleMesh mesh = test::lump(4);
    for (const Preset preset : {Preset::fast, Preset::best}) {
        Options options = with(preset);
        const auto levels =
            simplify_levels(mesh.view(), {ratio(0.5), model_units(0.03), model_units(0.1)}, options);
        for (const std::size_t i : {1u, 2u}) {
            options.max_error = model_units(i == 1 ? 0.03 : 0.1);
            check_same_level(levels[i].result, simplify(mesh.view(), options));
        }
    }
}

TEST_CASE("levels: a level finer than the previous one repeats its mesh") {
    const TriangleMesh mesh = test::lump(3);
    const auto levels =
        simplify_levels(mesh.view(), {faces(100), model_units(1e-6), faces(100)}, with(Preset::balanced));
    REQUIRE(levels.size() == 3);
    for (const std::size_t i : {1u, 2u}) {
        CHECK(levels[i].result.mesh.positions == levels[0].result.mesh.positions);
        CHECK(levels[i].error >= levels[0].error);
    }
    CHECK_FALSE(levels[1].result.report.max_error->within());
    CHECK_FALSE(levels[1].result.report.warnings.empty());
}

TEST_CASE("levels: ratio 1 keeps all faces, and an empty mesh gives empty levels") {
    const TriangleMesh mesh = test::lump(2);
    const auto levels = simplify_levels(mesh.view(), {ratio(1), ratio(0.5)});
    CHECK(levels[0].result.mesh.positions == mesh.positions);
    CHECK(levels[0].error == 0);
    CHECK(levels[1].error > 0);
    CHECK(simplify_levels(mesh.view(), {}).empty());
    for (const SimplifiedLevel& level : simplify_levels({}, {ratio(0.5), ratio(0.1)})) {
        CHECK(level.result.mesh.triangles.empty());
        CHECK(level.error == 0);
    }
}

TEST_CASE("levels: values out of range or order are errors that name the level") {
    const TriangleMesh mesh = test::icosphere(2);
    const auto message = [&](const std::vector<Level>& levels, const Options& options = {}) {
        try {
            simplify_levels(mesh.view(), levels, options);
        } catch (const OptionError& error) {
            return std::string(error.what());
        }
        return std::string("no error");
    };
    const double nan = std::numeric_limits<double>::quiet_NaN();
    CHECK(message({ratio(0.5), ratio(0.6)}).find("level 1") != std::string::npos);
    CHECK(message({ratio(0.5), faces(1000)}).find("level 1") != std::string::npos);
    CHECK(message({of_diagonal(0.1), ratio(0.5), of_diagonal(0.01)}).find("level 2") != std::string::npos);
    for (const double bad : {0.0, -1.0, nan}) {
        CHECK(message({ratio(bad)}).find("level 0") != std::string::npos);
        CHECK(message({model_units(bad)}).find("level 0") != std::string::npos);
    }
    CHECK(message({ratio(1.5)}).find("level 0") != std::string::npos);
    CHECK(message({faces(0)}).find("level 0") != std::string::npos);
    CHECK(message({Target{}}).find("level 0") != std::string::npos);
    Options options{.target = ratio(0.5)};
    CHECK(message({ratio(0.5)}, options).find("target") != std::string::npos);
    options = {};
    options.max_error = model_units(1);
    CHECK(message({ratio(0.5)}, options).find("max_error") != std::string::npos);
}

TEST_CASE("levels that are complete are not measured once a later one is cancelled") {
    const TriangleMesh mesh = test::icosphere(5);
    const std::vector<Level> wanted = {ratio(0.5), ratio(0.3), faces(20)};
    Options options = with(Preset::fast);
    options.threads = 1;
    std::size_t calls = 0, in_last_collapses = 0;
    options.progress = [&](Phase, double done) {
        ++calls;
        if (done < 0.5) in_last_collapses = calls;  // the second half are the measurements
        return Continue::yes;
    };
    simplify_levels(mesh.view(), wanted, options);
    REQUIRE(calls > in_last_collapses + 10);
    calls = 0;
    options.progress = [&](Phase, double) {
        return ++calls == in_last_collapses ? Continue::cancel : Continue::yes;
    };
    const auto levels = simplify_levels(mesh.view(), wanted, options);
    CHECK(calls == in_last_collapses);
    REQUIRE_FALSE(levels.empty());
    CHECK(levels.back().result.report.stop == StopReason::cancelled);
}

TEST_CASE("levels: progress increases to 1") {
    const TriangleMesh mesh = test::lump(4);
    for (const Preset preset : {Preset::balanced, Preset::qem}) {
        const std::vector<Level> wanted = {ratio(0.5), of_diagonal(0.02), faces(20)};
        Options options = with(preset);
        double last = 0;
        options.progress = [&](Phase, double done) {
            CHECK(done >= last);
            CHECK(done <= 1);
            last = done;
            return Continue::yes;
        };
        simplify_levels(mesh.view(), wanted, options);
        CHECK(last == Approx(1));
    }
}
