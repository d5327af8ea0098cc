#include "faqem/detail/fitting/vertex_fitting.hpp"

#include "faqem/compare.hpp"
#include "faqem/simplify.hpp"
#include "support/catch.hpp"
#include "support/meshes.hpp"

using namespace faqem;
using engine::Vector3;

namespace {

TriangleMesh fitted(const TriangleMesh& original, const TriangleMesh& simplified,
                    std::vector<std::uint8_t> fixed = {}, std::uint32_t threads = 1) {
    fixed.resize(simplified.positions.size(), 0);
    const std::vector<Vector3> from = test::vectors(original), to = test::vectors(simplified);
    TriangleMesh result = simplified;
    const std::vector<Vector3> moved =
        detail::fit_vertices({from, original.triangles}, {to, simplified.triangles}, fixed, 0.3,
                             detail::EdgeFlips::off, {}, threads)
            .positions;
    for (std::size_t v = 0; v < moved.size(); ++v) result.positions[v] = engine::to_array(moved[v]);
    return result;
}

Comparison compared(const TriangleMesh& a, const TriangleMesh& b) {
    return compare(a.view(), b.view(), {.samples = 20'000});
}

}  // namespace

TEST_CASE("vertex fitting: an inscribed icosphere is moved closer to the sphere") {
    const TriangleMesh sphere = test::icosphere(4), simplified = test::icosphere(1);
    const TriangleMesh result = fitted(sphere, simplified);
    const Comparison before = compared(sphere, simplified), after = compared(sphere, result);
    CHECK(after.chamfer < 0.6 * before.chamfer);
    CHECK(after.hausdorff <= before.hausdorff);
    CHECK(result.triangles == simplified.triangles);
}

TEST_CASE("vertex fitting: vertices do not move if the mesh equals the original") {
    const TriangleMesh cube = test::cube();
    const TriangleMesh result = fitted(cube, cube);
    for (std::size_t v = 0; v < cube.positions.size(); ++v) {
        CHECK((engine::to_eigen(result.positions[v]) - engine::to_eigen(cube.positions[v])).norm() < 1e-9);
    }
}

TEST_CASE("vertex fitting: fixed vertices and boundary vertices do not move") {
    const TriangleMesh bumpy = test::shaken(test::grid(24), 0.02, 3);
    const TriangleMesh simplified = test::grid(4);
    TriangleMesh scaled = simplified;
    for (Vec3& p : scaled.positions) p = {p[0] * 6, p[1] * 6, p[2]};
    std::vector<std::uint8_t> fixed(scaled.positions.size(), 0);
    fixed[12] = 1;  // the centre of 5 x 5 vertices
    const TriangleMesh result = fitted(bumpy, scaled, fixed);
    std::size_t moved = 0;
    for (std::size_t v = 0; v < 25; ++v) {
        const bool inner = v % 5 != 0 && v % 5 != 4 && v / 5 != 0 && v / 5 != 4;
        if (!inner || v == 12) CHECK(result.positions[v] == scaled.positions[v]);
        moved += result.positions[v] != scaled.positions[v];
    }
    CHECK(moved > 0);
}

TEST_CASE("vertex fitting: a decrease in distance must outweigh the increase in normal deviation") {
    // A cube is fitted to a cube with rounded edges. Moving its corners inwards would tilt the flat sides.
    TriangleMesh rounded = test::icosphere(4);
    for (Vec3& p : rounded.positions) {
        const double largest = std::max({std::abs(p[0]), std::abs(p[1]), std::abs(p[2])});
        for (double& x : p) x = std::clamp(1.1 * x / largest, -1.0, 1.0);
    }
    const TriangleMesh cube = test::moved(test::scaled(test::cube(), 2), {-1, -1, -1});
    const Comparison before = compared(rounded, cube), after = compared(rounded, fitted(rounded, cube));
    const double distances = after.chamfer / before.chamfer;
    const double normals = after.mean_normal_degrees / before.mean_normal_degrees;
    CHECK(distances * normals * normals <= 1.001);
}

TEST_CASE("vertex fitting: the result does not depend on the number of threads") {
    const TriangleMesh sphere = test::shaken(test::icosphere(3), 0.03, 1), simplified = test::icosphere(1);
    CHECK(fitted(sphere, simplified, {}, 1).positions == fitted(sphere, simplified, {}, 3).positions);
}

TEST_CASE("vertex fitting: no face is inverted or loses its area") {
    const TriangleMesh rough = test::shaken(test::icosphere(4), 0.1, 9);
    const SimplifyResult balanced =
        simplify(rough.view(), {.target = faces(120), .preset = Preset::balanced});
    const TriangleMesh moved = fitted(rough, balanced.mesh);
    CHECK(moved.positions != balanced.mesh.positions);
    for (const Triangle& t : moved.triangles) {
        const auto normal = [&](const TriangleMesh& mesh) {
            return engine::area_vector(engine::to_eigen(mesh.positions[t[0]]),
                                       engine::to_eigen(mesh.positions[t[1]]),
                                       engine::to_eigen(mesh.positions[t[2]]));
        };
        const Vector3 before = normal(balanced.mesh), after = normal(moved);
        REQUIRE(before.dot(after) >= 0.299 * before.norm() * after.norm());
        REQUIRE(after.norm() > 0);
    }
    CHECK(compared(rough, moved).chamfer < compared(rough, balanced.mesh).chamfer);
}

TEST_CASE("vertex fitting: edge flips decrease the distance further and keep the surface closed") {
    const TriangleMesh rough = test::shaken(test::icosphere(4), 0.1, 9);
    const SimplifyResult balanced =
        simplify(rough.view(), {.target = faces(120), .preset = Preset::balanced});
    const SimplifyResult best = simplify(rough.view(), {.target = faces(120), .preset = Preset::best});
    CHECK(best.report.vertices_fitted > 0);
    CHECK(best.report.edges_flipped > 0);
    CHECK(balanced.report.vertices_fitted == 0);
    CHECK(balanced.report.edges_flipped == 0);
    CHECK(best.mesh.triangles.size() == 120);
    CHECK(test::euler(best.mesh.triangles) == test::euler(balanced.mesh.triangles));
    CHECK(info(best.mesh.view()).boundary_edges == 0);
    const TriangleMesh moved = fitted(rough, balanced.mesh);
    CHECK(compared(rough, best.mesh).chamfer < compared(rough, moved).chamfer);
}

TEST_CASE("vertex fitting: the history stores the final positions and keeps those of the versions") {
    const TriangleMesh mesh = test::shaken(test::icosphere(3), 0.05, 2);
    const SimplifyResult r =
        simplify(mesh.view(), {.target = ratio(0.1), .preset = Preset::best, .history = Recording::on});
    const SimplifyResult plain =
        simplify(mesh.view(), {.target = ratio(0.1), .preset = Preset::balanced, .history = Recording::on});
    REQUIRE(r.history.remaining_versions == plain.history.remaining_versions);
    CHECK(r.history.final_positions == r.mesh.positions);
    CHECK(plain.history.final_positions.empty());
    CHECK(replay(r.history).positions == r.mesh.positions);
    CHECK(replay(r.history).triangles == r.mesh.triangles);
    CHECK(r.history.patch_count() == r.history.collapses.size() + r.report.edges_flipped);
    for (std::size_t i = 0; i < plain.mesh.positions.size(); ++i) {
        CHECK(r.history.position(r.history.remaining_versions[i]) == plain.mesh.positions[i]);
    }
}
