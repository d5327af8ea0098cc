#include "faqem/simplify.hpp"

#include <algorithm>
#include <limits>

#include "faqem/error.hpp"
#include "support/catch.hpp"
#include "support/meshes.hpp"
#include "support/results.hpp"

using namespace faqem;
using test::refused;
using test::same_bits;
using test::taken;

namespace {

Options options(Preset preset, Target target) { return {.target = target, .preset = preset}; }

// x and y of each corner as its UV, shifted by 10 for faces with x > cut.
CornerAttributes planar_uv(const TriangleMesh& mesh, double cut) {
    CornerAttributes uv;
    uv.width = 2;
    for (const Triangle& t : mesh.triangles) {
        const double middle =
            (mesh.positions[t[0]][0] + mesh.positions[t[1]][0] + mesh.positions[t[2]][0]) / 3;
        for (const Index v : t) {
            uv.values.push_back(static_cast<float>(mesh.positions[v][0] + (middle > cut ? 10 : 0)));
            uv.values.push_back(static_cast<float>(mesh.positions[v][1]));
        }
    }
    return uv;
}

bool has(const std::vector<Vec3>& positions, const Vec3& p) {
    return std::find(positions.begin(), positions.end(), p) != positions.end();
}

}  // namespace

TEST_CASE("ratio 1 returns the input exactly and in order") {
    TriangleMesh mesh = test::shaken(test::both(test::grid(3), test::moved(test::book(), {9, 0, 0})), 0.1, 3);
    mesh.positions[5][2] = 1.0 / 3;
    for (Index f = 0; f < mesh.triangles.size(); ++f) mesh.face_groups.push_back(f % 3);
    mesh.attributes = planar_uv(mesh, 1.5);
    for (const Preset preset : all_presets) {
        const SimplifyResult result = simplify(mesh.view(), options(preset, ratio(1)));
        CHECK(same_bits(result.mesh, mesh));
        CHECK(result.report.stop == StopReason::reached_target);
        CHECK(result.report.collapses == 0);
        CHECK(result.report.faces_in == mesh.triangles.size());
        CHECK(result.report.faces_out == mesh.triangles.size());
        CHECK(result.report.vertices_in == mesh.positions.size());
        CHECK(result.report.vertices_out == mesh.positions.size());
        CHECK(result.report.preset == preset);
        for (Index i = 0; i < result.face_origin.size(); ++i) CHECK(result.face_origin[i] == i);
        for (Index i = 0; i < result.vertex_origin.size(); ++i) CHECK(result.vertex_origin[i] == i);
    }
}

TEST_CASE("preset best does not change a mesh without collapses") {
    // Every face is present twice: only the duplicates are removed.
    const TriangleMesh mesh = test::shaken(test::icosphere(3), 0.02, 3);
    TriangleMesh twice = mesh;
    twice.triangles.insert(twice.triangles.end(), mesh.triangles.begin(), mesh.triangles.end());
    const SimplifyResult result = simplify(twice.view(), options(Preset::best, ratio(0.5)));
    CHECK(same_bits(result.mesh, mesh));
    CHECK(result.report.vertices_fitted == 0);
    CHECK(result.report.edges_flipped == 0);
}

TEST_CASE("preset best does not draw vertices to components that were removed") {
    const TriangleMesh sphere = test::icosphere(3);
    TriangleMesh mesh = sphere;
    for (const double z : {-1.4, 1.4})
        mesh = test::both(mesh, test::moved(test::scaled(test::tetrahedron(), 0.1), {0, 0, z}));
    const SimplifyResult result = simplify(mesh.view(), options(Preset::best, faces(20)));
    const SimplifyResult alone = simplify(sphere.view(), options(Preset::best, faces(20)));
    const auto farthest = [](const SimplifyResult& r) {
        double square = 0;
        for (const Vec3& p : r.mesh.positions)
            square = std::max(square, p[0] * p[0] + p[1] * p[1] + p[2] * p[2]);
        return std::sqrt(square);
    };
    for (const Index face : result.face_origin) CHECK(face < sphere.triangles.size());
    CHECK(farthest(result) == Approx(farthest(alone)).epsilon(0.05));
}

TEST_CASE("float positions are returned without rounding") {
    std::vector<Vec3f> positions;
    const TriangleMesh grid = test::shaken(test::grid(2), 0.1, 1);
    for (const Vec3& p : grid.positions)
        positions.push_back({static_cast<float>(p[0]), static_cast<float>(p[1]), static_cast<float>(p[2])});
    MeshView view{.positions = positions, .triangles = grid.triangles};
    const SimplifyResult result = simplify(view, options(Preset::qem, ratio(1)));
    for (std::size_t i = 0; i < positions.size(); ++i)
        CHECK(result.mesh.positions[i] == Vec3{positions[i][0], positions[i][1], positions[i][2]});
}

TEST_CASE("targets are ratios or face counts of at least four faces") {
    const TriangleMesh mesh = test::icosphere(1);  // 80 faces
    const auto target = [&](Target t) {
        return simplify(mesh.view(), options(Preset::qem, t)).report.target_faces;
    };
    CHECK(target(ratio(1)) == 80);
    CHECK(target(ratio(0.5)) == 40);
    CHECK(target(ratio(0.1)) == 8);
    CHECK(target(ratio(0.0999)) == 7);
    CHECK(target(ratio(0.3)) == 24);
    CHECK(target(ratio(0.01)) == 4);
    CHECK(target(faces(33)) == 33);
    CHECK(target(faces(1)) == 4);
    CHECK(target(faces(1'000'000)) == 1'000'000);
    // Products such as 0.1 * 30 count as integers in spite of rounding errors.
    for (std::uint64_t tens = 1; tens < 8; ++tens)
        CHECK(target(ratio(static_cast<double>(tens) / 80)) == std::max<std::uint64_t>(4, tens));
}

TEST_CASE("the result has at most one face less than the target") {
    for (const Preset preset : all_presets) {
        for (const std::uint64_t n : {60u, 33u, 10u, 4u}) {
            const Report report = simplify(test::icosphere(1).view(), options(preset, faces(n))).report;
            CHECK(report.stop == StopReason::reached_target);
            CHECK(report.faces_out <= n);
            CHECK(report.faces_out + 2 > n);
        }
    }
}

TEST_CASE("a coplanar grid keeps its area with presets that have boundary terms") {
    // stmw and paper keep the four corners: all cheaper positions are on the sides.
    for (const Preset preset : {Preset::paper, Preset::stmw}) {
        const SimplifyResult result = simplify(test::grid(10).view(), options(preset, ratio(0.1)));
        double area = 0;
        for (const Triangle& t : result.mesh.triangles) area += test::normal(result.mesh, t)[2] / 2;
        CHECK(area == Approx(100).epsilon(0.01));
    }
}

TEST_CASE("an empty mesh gives an empty result") {
    for (const Preset preset : all_presets) {
        Options o = options(preset, ratio(0.5));
        o.history = Recording::on;
        const SimplifyResult result = simplify({}, o);
        CHECK(result.mesh.triangles.empty());
        CHECK(result.mesh.positions.empty());
        CHECK(result.report.stop == StopReason::reached_target);
        validate(result.history);
        TriangleMesh points;
        points.positions = {{0, 0, 0}, {1, 1, 1}};
        CHECK(simplify(points.view(), o).mesh.positions.empty());
    }
}

TEST_CASE("a single triangle is kept and a single degenerate triangle gives an empty result") {
    const TriangleMesh triangle = test::make({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}});
    CHECK(simplify(triangle.view(), options(Preset::paper, faces(1))).mesh.triangles.size() == 1);
    const SimplifyResult degenerate =
        simplify(test::scaled(triangle, 0).view(), options(Preset::paper, faces(1)));
    CHECK(degenerate.mesh.triangles.empty());
    CHECK(degenerate.report.faces_dropped == 1);
    REQUIRE(degenerate.report.warnings.size() == 2);
    CHECK(degenerate.report.warnings[0].find("1 degenerate or duplicate faces") == 0);
    CHECK(degenerate.report.warnings[1].find("the result is empty") != std::string::npos);
}

TEST_CASE("faces of zero area are removed and counted") {
    // The face 0 1 4 is degenerate: vertex 4 is on the edge 0-1 of the square.
    TriangleMesh mesh = test::quad();
    mesh.positions.push_back({0.5, 0, 0});
    mesh.triangles.push_back({0, 1, 4});
    const SimplifyResult result = simplify(mesh.view(), options(Preset::qem, ratio(1)));
    CHECK(same_bits(result.mesh, test::quad()));
    CHECK(result.report.faces_dropped == 1);
    CHECK(result.report.faces_in == 3);
}

TEST_CASE("no faces are lost at scales from 1e-300 to 1e300") {
    for (const double size : {1e-300, 1e-100, 1e-30, 1e30, 1e38, 1e100, 1e300}) {
        for (const Preset preset : all_presets) {
            Options o = options(preset, ratio(0.5));
            o.topology.weld_distance = 0;
            const Report report = simplify(test::scaled(test::icosphere(1), size).view(), o).report;
            INFO(size << " " << name(preset));
            CHECK(report.faces_out == 40);
            CHECK(report.faces_dropped == 0);
        }
    }
}

TEST_CASE("the result does not depend on repetition, recording or the number of threads") {
    const TriangleMesh mesh = test::both(test::shaken(test::torus(12, 8), 0.05, 2), test::soup(3, 20, 40));
    for (const Preset preset : all_presets) {
        Options o = options(preset, ratio(0.2));
        const SimplifyResult first = simplify(mesh.view(), o);
        const SimplifyResult second = simplify(mesh.view(), o);
        CHECK(same_bits(first.mesh, second.mesh));
        CHECK(first.face_origin == second.face_origin);
        CHECK(first.report.refusals == second.report.refusals);
        CHECK(first.history.empty());
        o.history = Recording::on;
        const SimplifyResult recorded = simplify(mesh.view(), o);
        CHECK(same_bits(first.mesh, recorded.mesh));
        CHECK(first.vertex_origin == recorded.vertex_origin);
        CHECK(recorded.history.collapses.size() == recorded.report.collapses);
        o.history = Recording::off;
        o.threads = 3;
        CHECK(same_bits(first.mesh, simplify(mesh.view(), o).mesh));
    }
}

TEST_CASE("vertices split by attributes are welded so that no cracks open") {
    const TriangleMesh split = test::separated(test::icosphere(2));
    for (const Preset preset : all_presets) {
        const SimplifyResult result = simplify(split.view(), options(preset, ratio(0.2)));
        CHECK(test::closed_manifold(result.mesh.triangles));
        CHECK(result.report.vertices_in == 960);
        for (const Index v : result.vertex_origin) CHECK(v < 960);
    }
}

TEST_CASE("locked vertices keep their positions exactly") {
    const TriangleMesh mesh = test::shaken(test::icosphere(2), 0.02, 4);
    std::vector<std::uint8_t> locks(mesh.positions.size(), 0);
    for (std::size_t v = 0; v < locks.size(); v += 9) locks[v] = 1;
    MeshView view{.positions = mesh.positions, .triangles = mesh.triangles, .vertex_locks = locks};
    for (const Preset preset : all_presets) {
        const SimplifyResult result = simplify(view, options(preset, ratio(0.3)));
        CHECK(result.report.faces_out < 110);
        for (std::size_t v = 0; v < locks.size(); v += 9) {
            const auto at =
                std::find(result.mesh.positions.begin(), result.mesh.positions.end(), mesh.positions[v]);
            REQUIRE(at != result.mesh.positions.end());
            CHECK(result.vertex_origin[static_cast<std::size_t>(at - result.mesh.positions.begin())] == v);
        }
    }
}

TEST_CASE("a mesh with all vertices locked is returned unchanged with the reason") {
    const TriangleMesh mesh = test::icosphere(1);
    const std::vector<std::uint8_t> locks(mesh.positions.size(), 1);
    MeshView view{.positions = mesh.positions, .triangles = mesh.triangles, .vertex_locks = locks};
    const SimplifyResult result = simplify(view, options(Preset::paper, ratio(0.1)));
    CHECK(same_bits(result.mesh, mesh));
    CHECK(result.report.stop == StopReason::no_legal_collapse);
    CHECK(refused(result.report, Refusal::locked) >= 120);
    CHECK(result.report.warnings ==
          std::vector<std::string>{
              "the target of 8 faces was not reached: all collapses that are left are refused, "
              "most of them as 'locked'"});
    CHECK(result.report.collapses == 0);
}

TEST_CASE("a locked boundary keeps all of its vertices") {
    const TriangleMesh mesh = test::shaken(test::grid(8), 0.1, 5);
    for (const Preset preset : all_presets) {
        Options o = options(preset, ratio(0.4));
        o.topology.boundary = Boundary::locked;
        const SimplifyResult result = simplify(mesh.view(), o);
        CHECK(result.report.faces_out <= 51);
        for (Index v = 0; v < 81; ++v) {
            const bool is_boundary = v % 9 == 0 || v % 9 == 8 || v / 9 == 0 || v / 9 == 8;
            if (is_boundary) CHECK(has(result.mesh.positions, mesh.positions[v]));
        }
    }
}

TEST_CASE("UVs are interpolated and UV seams are preserved") {
    TriangleMesh mesh = test::grid(8);
    mesh.attributes = planar_uv(mesh, 4);
    for (const Preset preset : all_presets) {
        const SimplifyResult result = simplify(mesh.view(), options(preset, ratio(0.4)));
        const TriangleMesh& out = result.mesh;
        CHECK(result.report.faces_out <= 51);
        REQUIRE(out.attributes.values.size() == 6 * out.triangles.size());
        // The surface is flat and the UV map linear: the UV of a corner is its position, shifted in the right
        // chart.
        bool good = true;
        for (std::size_t f = 0; f < out.triangles.size(); ++f) {
            const bool right = out.attributes.values[6 * f] > 9;
            for (std::size_t c = 0; c < 3; ++c) {
                const Vec3& p = out.positions[out.triangles[f][c]];
                const float* uv = &out.attributes.values[6 * f + 2 * c];
                const double x = p[0] + (right ? 10 : 0);
                // UVs of points outside the square are clamped.
                good = good && (std::abs(uv[0] - x) < 1e-5 || p[0] < 0 || p[0] > 8 || p[1] < 0 || p[1] > 8);
                good = good && (right ? p[0] > 4 - 1e-9 : p[0] < 4 + 1e-9);
            }
        }
        CHECK(good);
    }
}

TEST_CASE("attributes of corners that did not move are kept exactly") {
    TriangleMesh mesh = test::shaken(test::grid(6), 0.2, 7);
    test::Random random(8);
    mesh.attributes.width = 3;
    std::vector<float> value;
    for (std::size_t i = 0; i < 3 * 49; ++i) value.push_back(static_cast<float>(random.between(-9, 9)));
    for (const Triangle& t : mesh.triangles) {
        for (const Index v : t)
            mesh.attributes.values.insert(mesh.attributes.values.end(), &value[3 * v], &value[3 * v] + 3);
    }
    for (const Preset preset : all_presets) {
        if (preset == Preset::best) continue;  // moves nearly all vertices
        const SimplifyResult result = simplify(mesh.view(), options(preset, ratio(0.5)));
        std::size_t compared = 0, equal = 0;
        for (std::size_t f = 0; f < result.mesh.triangles.size(); ++f) {
            for (unsigned c = 0; c < 3; ++c) {
                const Index was = mesh.triangles[result.face_origin[f]][c];
                if (result.mesh.positions[result.mesh.triangles[f][c]] != mesh.positions[was]) continue;
                ++compared;
                const float* kept = &result.mesh.attributes.values[9 * f + 3 * c];
                equal += std::equal(kept, kept + 3, &value[3 * was]);
            }
        }
        CHECK(compared > 20);
        CHECK(equal == compared);
    }
}

TEST_CASE("faces keep their groups") {
    TriangleMesh mesh = test::icosphere(2);
    for (Index f = 0; f < mesh.triangles.size(); ++f) mesh.face_groups.push_back(f / 100);
    const SimplifyResult result = simplify(mesh.view(), options(Preset::stmw, ratio(0.3)));
    REQUIRE(result.mesh.face_groups.size() == result.mesh.triangles.size());
    for (std::size_t f = 0; f < result.face_origin.size(); ++f)
        CHECK(result.mesh.face_groups[f] == mesh.face_groups[result.face_origin[f]]);
}

TEST_CASE("the ladder deletes tiny components before it lifts the link condition") {
    const TriangleMesh mesh =
        test::both(test::tetrahedron(), test::moved(test::scaled(test::tetrahedron(), 1e-3), {1, 1, 1}));
    const SimplifyResult result = simplify(mesh.view(), options(Preset::qem, faces(4)));
    CHECK(same_bits(result.mesh, test::tetrahedron()));
    CHECK(taken(result.report, Rung::reseed) == 1);
    CHECK(taken(result.report, Rung::tiny_components) == 1);
    CHECK(taken(result.report, Rung::without_link) == 0);
    CHECK(result.report.components_deleted == 1);
    REQUIRE(result.report.warnings.size() == 1);
    CHECK(result.report.warnings[0] == "1 small components were deleted to reach the target");
}

TEST_CASE("the ladder lifts the link condition if there are no tiny components") {
    const TriangleMesh mesh = test::both(test::tetrahedron(), test::moved(test::tetrahedron(), {5, 0, 0}));
    const SimplifyResult result = simplify(mesh.view(), options(Preset::qem, faces(4)));
    CHECK(result.report.faces_out <= 4);
    CHECK(result.report.faces_out > 0);
    CHECK(taken(result.report, Rung::tiny_components) == 0);
    CHECK(taken(result.report, Rung::without_link) == 1);
    CHECK(refused(result.report, Refusal::link) >= 12);
}

TEST_CASE("virtual edges join components that are close to each other") {
    // The surfaces are rough enough that closing the gap is cheaper than flattening them.
    TriangleMesh mesh = test::both(test::grid(6), test::moved(test::grid(6), {6.05, 0, 0}));
    test::Random random(1);
    for (Vec3& p : mesh.positions) p[2] = random.between(-0.06, 0.06);
    for (const Preset preset : all_presets) {
        Options o = options(preset, faces(16));
        CHECK(simplify(mesh.view(), o).report.virtual_edges == 0);
        o.topology.virtual_edges = VirtualEdges::on;
        const SimplifyResult result = simplify(mesh.view(), o);
        CHECK(result.report.virtual_edges == 7);  // one for each pair of opposite vertices
        if (preset == Preset::qem) continue;      // the link condition does not permit joining boundaries
        // A face of the result that spans the gap.
        const bool joined =
            std::any_of(result.mesh.triangles.begin(), result.mesh.triangles.end(), [&](const Triangle& t) {
                const auto [low, high] = std::minmax(
                    {result.vertex_origin[t[0]], result.vertex_origin[t[1]], result.vertex_origin[t[2]]});
                return low < 49 && high >= 49;
            });
        CHECK(joined);
    }
}

TEST_CASE("the progress callback gets increasing fractions and can cancel or throw") {
    const TriangleMesh mesh = test::shaken(test::icosphere(4), 0.001, 1);
    Options o = options(Preset::qem, ratio(0.01));
    double last = 0;
    int calls = 0;
    bool is_welded = false;
    o.progress = [&](Phase phase, double done) {
        CHECK(phase == (is_welded ? Phase::simplify : phase));
        is_welded = phase != Phase::weld;
        CHECK(done >= last);
        CHECK(done <= 1);
        last = done;
        return done > 0 && ++calls == 2 ? Continue::cancel : Continue::yes;
    };
    const SimplifyResult result = simplify(mesh.view(), o);
    CHECK(calls == 2);
    CHECK(result.report.stop == StopReason::cancelled);
    CHECK(result.report.faces_out > result.report.target_faces);
    CHECK(result.report.faces_out < mesh.triangles.size());
    CHECK(test::closed_manifold(result.mesh.triangles));
    o.progress = [](Phase, double) -> Continue { throw std::runtime_error("from the callback"); };
    CHECK_THROWS_WITH(simplify(mesh.view(), o), "from the callback");
}

TEST_CASE("invalid options and invalid input throw") {
    CHECK_THROWS_AS(simplify(test::quad().view(), options(Preset::qem, ratio(0))), OptionError);
    TriangleMesh mesh = test::quad();
    mesh.triangles[0][1] = 99;
    CHECK_THROWS_WITH(simplify(mesh.view()), "face 0: vertex index 99 is out of range: there are 4 vertices");
    mesh = test::quad();
    mesh.positions[3][0] = std::numeric_limits<double>::quiet_NaN();
    CHECK_THROWS_WITH(simplify(mesh.view()), "vertex 3: position is not finite: nan");
    CHECK_THROWS_AS(simplify(mesh.view()), InputError);
}

TEST_CASE("a vertex with 20,000 triangles is simplified to the target") {
    for (const Preset preset : {Preset::paper, Preset::stmw}) {
        TriangleMesh mesh = test::fan(20'000);
        mesh.positions[0][2] = 1;
        const Report report = simplify(mesh.view(), options(preset, ratio(0.1))).report;
        CHECK(report.faces_out == 2000);
    }
}
