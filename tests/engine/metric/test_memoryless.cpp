#include "faqem/engine/metric/memoryless.hpp"

#include "faqem/engine/recorder.hpp"
#include "faqem/simplify.hpp"
#include "support/catch.hpp"
#include "support/meshes.hpp"

using namespace faqem;
using namespace faqem::engine;

namespace {

Candidate evaluated(const CollapseMesh& collapse_mesh, Index u, Index v,
                    const MemorylessWeights& weights = {},
                    AllowedPosition position = AllowedPosition::anywhere) {
    const PairTable pairs(collapse_mesh, {});
    MemorylessMetric metric(weights);
    metric.initialise(collapse_mesh, pairs);
    const auto found = metric.evaluate(collapse_mesh, pairs, test::pair_of(pairs, u, v), position);
    REQUIRE(found);
    return *found;
}

// The cost of collapsing (0, 2) to 2.
double cost_at_2(const CollapseMesh& collapse_mesh, const MemorylessWeights& weights) {
    return evaluated(collapse_mesh, 0, 2, weights, AllowedPosition::at_second).cost;
}

// Two unit squares side by side in the plane, as four triangles:
//
//   3---4---5
//   | / | / |
//   0---1---2
CollapseMesh strip() {
    return CollapseMesh({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 1, 0}, {1, 1, 0}, {2, 1, 0}},
                        {{0, 1, 4}, {0, 4, 3}, {1, 2, 5}, {1, 5, 4}});
}

}  // namespace

TEST_CASE("memoryless: a boundary edge costs its squared length times the squared distance from its line") {
    // Collapsing (0, 1) to a point at height y: the faces are in the plane, so that only boundary planes
    // count. At 0: x = 0 and y = 0; at 1: y = 0 twice, from the edges (0, 1) and (1, 2); minus half of the
    // planes of the shared edge (0, 1).
    CHECK(evaluated(strip(), 0, 1, {}, AllowedPosition::at_first).cost == Approx(0).margin(1e-15));
    // Squared distance 1 from the plane x = 0 of edge (0, 3), which has length 1.
    CHECK(evaluated(strip(), 0, 1, {}, AllowedPosition::at_second).cost == Approx(1));
}

TEST_CASE("memoryless: without edge weights all collapses in a plane cost nothing") {
    CHECK(evaluated(strip(), 1, 4, {0, 0, 0}).cost == Approx(0).margin(1e-15));
}

TEST_CASE("memoryless: a shared face counts one and a half times") {
    // A ridge: two triangles at the edge (0, 1), one in z = 0, one in y = 0; both vertices are in both
    // faces.
    const CollapseMesh ridge({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 1, 2}, {1, 0, 3}});
    // (0, 2) shares the face in z = 0, which contains vertex 2; the other face has area 1/2 and distance 1.
    CHECK(cost_at_2(ridge, {0, 0, 0}) == Approx(0.5));
}

TEST_CASE("memoryless: collapsing an edge of a cube has a high cost") {
    const CollapseMesh cube = test::collapse_mesh_of(test::cube());
    const Triangle& t = cube.triangle(0);
    // Any point off a corner or edge is outside the plane of a face of area 1.
    CHECK(evaluated(cube, t[0], t[1]).cost > 0.1);
}

TEST_CASE("memoryless: edges at which the surface folds back have planes, edges of a cube do not") {
    // Two nearly coincident triangles at the edge (0, 1). The normal of (1, 0, 2) points down, the other
    // up.
    const auto cost = [](double height, double fold) {
        const CollapseMesh blade({{0, 0, 0}, {1, 0, 0}, {0.5, 1, 0}, {0.5, 1, height}},
                                 {{1, 0, 2}, {0, 1, 3}});
        return cost_at_2(blade, {0, 0, fold});
    };
    // Vertex 2 has distance 1 from the fold edge of length 1, along which each face has a plane.
    CHECK(cost(0.01, 0.2) - cost(0.01, 0) == Approx(0.4).epsilon(1e-3));
    CHECK(cost(10, 0.2) == cost(10, 0));
}

TEST_CASE("memoryless: a flat edge between inconsistent windings is not a fold") {
    // Two coplanar triangles at the edge (0, 1) with inconsistent windings.
    const CollapseMesh flat({{0, 0, 0}, {1, 0, 0}, {0.5, 1, 0}, {0.5, -1, 0}}, {{1, 0, 2}, {1, 0, 3}});
    CHECK(cost_at_2(flat, {0, 0, 0.2}) == cost_at_2(flat, {0, 0, 0}));
}

TEST_CASE("memoryless: a non-manifold edge has planes if a face ends there, not if all faces continue") {
    // Faces at the edge (0, 1): a flat patch with vertices 2 and 3, and a perpendicular face to 4 that may
    // continue to 5.
    const std::vector<Vector3> p = {{0, 0, 0},    {1, 0, 0},   {0.5, 1, 0},
                                    {0.5, -1, 0}, {0.5, 0, 1}, {0.5, 0, -1}};
    const auto held = [&](const std::vector<Triangle>& triangles) {
        const CollapseMesh collapse_mesh(p, triangles);
        return cost_at_2(collapse_mesh, {0, 5, 0}) - cost_at_2(collapse_mesh, {0, 0, 0});
    };
    // The planes along the edge are y = 0 twice and z = 0. Vertex 2 has distance 1 from the first two.
    CHECK(held({{0, 1, 2}, {1, 0, 3}, {0, 1, 4}}) == Approx(2 * 5));
    CHECK(held({{0, 1, 2}, {1, 0, 3}, {1, 0, 4}}) == Approx(2 * 5));
    CHECK(held({{0, 1, 2}, {1, 0, 3}, {0, 1, 4}, {1, 0, 5}}) == Approx(0).margin(1e-12));
    CHECK(held({{0, 1, 2}, {1, 0, 2}, {1, 0, 3}, {0, 1, 3}}) == Approx(0).margin(1e-12));
}

TEST_CASE("memoryless: the last faces of a component cost 33 times the square of their area") {
    // The planes along boundary edges add 54; those along folds, 0.4 times as much.
    const std::vector<Vector3> p = {{0, 0, 0}, {3, 0, 0}, {0, 4, 0}};
    const CollapseMesh triangle(p, {{0, 1, 2}});
    const CollapseMesh doubled(p, {{0, 1, 2}, {0, 2, 1}});
    CHECK(evaluated(triangle, 0, 1).cost == Approx(33 * 36 + 54));
    CHECK(evaluated(doubled, 0, 1).cost == Approx(33 * 144 + 0.4 * 54));
    // The component does not vanish if it has other faces.
    CHECK(evaluated(test::collapse_mesh_of(test::quad()), 0, 1).cost < 100);
}

TEST_CASE("memoryless: of separate faces a long thin one vanishes before shorter ones of larger area") {
    TriangleMesh mesh = test::make({{0, -2, 0}, {0, -2.1, 0}, {10, -2, 0}}, {{0, 1, 2}});
    const TriangleMesh card = test::make({{0, 0, 0}, {2, 0, 0}, {0, 2, 0}}, {{0, 1, 2}});
    for (int i = 0; i < 4; ++i) mesh = test::both(mesh, test::moved(card, {2.5 * i, 0, 0}));
    const SimplifyResult result = simplify(mesh.view(), {.target = faces(4), .preset = Preset::fast});
    REQUIRE(result.mesh.triangles.size() == 4);
    for (const Vec3& p : result.mesh.positions) CHECK(p[1] >= 0);
}

TEST_CASE("memoryless: after collapses the costs equal those of a metric initialised with the current mesh") {
    const TriangleMesh mesh = test::icosphere(2);
    CollapseMesh collapse_mesh = test::collapse_mesh_of(mesh);
    PairTable pairs(collapse_mesh, {});
    MemorylessMetric metric;
    metric.initialise(collapse_mesh, pairs);
    std::vector<Index> killed;
    std::vector<PairTable::Change> changes;
    for (int round = 0; round < 40; ++round) {
        Index pair = static_cast<Index>(round * 7);
        while (!pairs.is_alive(pair)) ++pair;
        const Index u = pairs.first(pair), v = pairs.second(pair);
        const auto found = metric.evaluate(collapse_mesh, pairs, pair, AllowedPosition::anywhere);
        REQUIRE(found);
        metric.before_collapse(collapse_mesh, pairs, u, v, found->point);
        collapse_mesh.collapse(u, v, found->point);
        pairs.merge(collapse_mesh, u, v, killed, changes);
        metric.after_collapse(collapse_mesh, pairs, u, changes);
    }
    MemorylessMetric fresh;
    fresh.initialise(collapse_mesh, pairs);
    for (Index pair = 0; pair < pairs.size(); ++pair) {
        if (!pairs.is_alive(pair)) continue;
        const auto a = metric.evaluate(collapse_mesh, pairs, pair, AllowedPosition::anywhere);
        const auto b = fresh.evaluate(collapse_mesh, pairs, pair, AllowedPosition::anywhere);
        REQUIRE(a);
        REQUIRE(b);
        CHECK(a->cost == Approx(b->cost).epsilon(1e-9).margin(1e-15));
    }
}

TEST_CASE("memoryless: the preset fast warns that term weights have no effect") {
    const TriangleMesh mesh = test::icosphere(1);
    const SimplifyResult with =
        simplify(mesh.view(), {.target = ratio(0.5), .preset = Preset::fast, .weights = {.area = 5}});
    REQUIRE(with.report.warnings.size() == 1);
    CHECK_THAT(with.report.warnings[0], ContainsSubstring("preset fast does not use them"));
    CHECK(simplify(mesh.view(), {.target = ratio(0.5), .preset = Preset::fast}).report.warnings.empty());
}

TEST_CASE("memoryless: planes that are nearly parallel do not place vertices far outside the bounding box") {
    // The minimum of the quadric of one pair is eight lengths of the tube away.
    TriangleMesh mesh = test::cylinder(10, 10, 10);
    for (Vec3& p : mesh.positions) p[0] *= 0.1;
    mesh = test::shaken(mesh, 1e-4, 2);
    const CollapseMesh collapse_mesh = test::collapse_mesh_of(mesh);
    const PairTable pairs(collapse_mesh, {});
    MemorylessMetric metric;
    metric.initialise(collapse_mesh, pairs);
    Eigen::AlignedBox3d box;
    for (const Vec3& p : mesh.positions) box.extend(to_eigen(p));
    for (Index pair = 0; pair < pairs.size(); ++pair) {
        const auto found = metric.evaluate(collapse_mesh, pairs, pair, AllowedPosition::anywhere);
        REQUIRE(found);
        CHECK(placement_bounds(box).contains(found->point));
    }
}
