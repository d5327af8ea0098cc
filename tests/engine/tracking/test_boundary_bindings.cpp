#include "faqem/engine/tracking/boundary_bindings.hpp"

#include "faqem/compare.hpp"
#include "faqem/simplify.hpp"
#include "support/catch.hpp"
#include "support/original.hpp"

using namespace faqem;
using namespace faqem::engine;

namespace {

struct BindingsBench {
    explicit BindingsBench(const TriangleMesh& mesh)
        : original(mesh),
          collapse_mesh(original.positions, original.triangles),
          pairs(collapse_mesh, {}),
          bindings(original.surface, original.tracked, collapse_mesh, pairs) {}
    double squared_distance(Index u, Index v, const Vector3& p) {
        return bindings.squared_distance(collapse_mesh, pairs, u, v, p);
    }
    void collapse(Index u, Index v, const Vector3& p) {
        bindings.before_collapse(pairs, u, v);
        collapse_mesh.collapse(u, v, p);
        std::vector<Index> killed;
        std::vector<PairTable::Change> changes;
        pairs.merge(collapse_mesh, u, v, killed, changes);
        bindings.after_collapse(collapse_mesh, pairs, u, changes);
    }

    test::OriginalOf original;
    CollapseMesh collapse_mesh;
    PairTable pairs;
    BoundaryBindings bindings;
};

// The unit square with its centre.
//
//     3---2
//     | 4 |
//     0---1
const TriangleMesh square_with_centre =
    test::make({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5, 0.5, 0}},
               {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}});

// Unit squares in a row.
//
//     5---6---7---8---9
//     | / | / | / | / |
//     0---1---2---3---4
TriangleMesh strip() {
    TriangleMesh mesh;
    for (const double y : {0.0, 1.0}) {
        for (const double x : {0.0, 1.0, 2.0, 3.0, 4.0}) mesh.positions.push_back({x, y, 0});
    }
    for (Index i = 0; i < 4; ++i) {
        mesh.triangles.push_back({i, i + 1, i + 6});
        mesh.triangles.push_back({i, i + 6, i + 5});
    }
    return mesh;
}

}  // namespace

TEST_CASE("boundary bindings: corners that are cut off are measured to the new boundary") {
    BindingsBench bench(square_with_centre);
    // From 0 to the side between 3 and (0.5, 0)
    CHECK(bench.squared_distance(0, 1, {0.5, 0, 0}) == Approx(0.2));
    CHECK(bench.squared_distance(4, 0, {0.1, 0.1, 0}) == Approx(0.02));
    CHECK(bench.squared_distance(4, 0, {0, 0, 0}) == 0);
}

TEST_CASE("boundary bindings: the new vertex is measured to the original boundary") {
    BindingsBench bench(square_with_centre);
    CHECK(bench.squared_distance(0, 1, {0.5, -2, 0}) == Approx(4));
}

TEST_CASE("boundary bindings: an edge between two sides of the boundary is measured at its midpoint") {
    BindingsBench bench(strip());
    // Vertex 7 has distance sqrt(1/5) from the edge to 8; the midpoints of the edges to 6 and 8 have
    // distance 1/2 from both sides.
    CHECK(bench.squared_distance(1, 7, {1, 0, 0}) == Approx(0.25));
}

TEST_CASE("boundary bindings: bound vertices follow the boundary through collapses") {
    // The boundary of a disc of 16 triangles: vertices 2, 3, ... are merged into 1 one after the other.
    BindingsBench bench(test::fan(16));
    double last = 0;
    for (Index next = 2; next < 8; ++next) {
        const Vector3 p = bench.collapse_mesh.position(1);
        const double distance = bench.squared_distance(1, next, p);
        // The chord from 1 to next + 1 replaces an arc of `next` sides, whose midpoint is the farthest from
        // it.
        const double half = test::pi * next / 16;
        const double height = 1 - std::cos(half);
        CHECK(distance <= height * height * 1.0001);
        CHECK(distance >= 0.7 * height * height);
        CHECK(distance > last);
        last = distance;
        bench.collapse(1, next, p);
    }
}

TEST_CASE("boundary bindings: without vertices bound at the pair those of adjacent edges are used") {
    // Only corner 1 of the square is tracked: no vertex is bound to the edges at corner 3.
    const test::OriginalOf original(square_with_centre);
    CollapseMesh collapse_mesh(original.positions, original.triangles);
    PairTable pairs(collapse_mesh, {});
    TrackedVertices corner;
    corner.add(1, 1);
    BoundaryBindings bindings(original.surface, corner, collapse_mesh, pairs);
    CHECK(bindings.squared_distance(collapse_mesh, pairs, 4, 3, {0, 3, 0}) == Approx(1 + 4));  // to corner 2
    // The point is on the side (0, 1), but the midpoint of the edge to 2 has distance 1/4 from (1, 2).
    CHECK(bindings.squared_distance(collapse_mesh, pairs, 4, 3, {0.5, 0, 0}) == Approx(0.0625));
}

TEST_CASE("boundary bindings: a vertex merged into a distant one is bound to the boundary near itself") {
    // One corner of the strip is tracked, and was merged into the corner at the other end of its side. The
    // search has to follow the boundary, once towards larger vertices and once towards smaller ones.
    const test::OriginalOf original(strip());
    CollapseMesh collapse_mesh(original.positions, original.triangles);
    PairTable pairs(collapse_mesh, {});
    TrackedVertices right, left;
    right.add(4, 0);
    BoundaryBindings to_right(original.surface, right, collapse_mesh, pairs);
    // The new side from (3, 0) to 9 cuts off the corner.
    CHECK(to_right.squared_distance(collapse_mesh, pairs, 3, 4, {3, 0, 0}) == Approx(0.5));
    left.add(5, 9);
    BoundaryBindings to_left(original.surface, left, collapse_mesh, pairs);
    // The new side from 0 to (1, 1) does.
    CHECK(to_left.squared_distance(collapse_mesh, pairs, 5, 6, {1, 1, 0}) == Approx(0.5));
}

TEST_CASE("boundary bindings: the distance is 0 for inner pairs and for a loop that vanishes") {
    BindingsBench inside(test::icosphere(1));
    CHECK(inside.squared_distance(0, 12, {5, 5, 5}) == 0);
    BindingsBench triangle(test::make({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}));
    CHECK(triangle.squared_distance(0, 1, {0.5, 0, 0}) == 0);
}

TEST_CASE("boundary bindings: a new loop is ignored if the original has no boundary") {
    // Each side of the triangle 0 1 2 has two more faces, back to back.
    BindingsBench bench(
        test::make({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}},
                   {{0, 1, 2}, {0, 1, 3}, {1, 0, 3}, {1, 2, 4}, {2, 1, 4}, {2, 0, 5}, {0, 2, 5}}));
    bench.collapse(0, 3, {0, 0, 0});
    REQUIRE(bench.pairs.boundary_degree(0) > 0);
    CHECK(bench.squared_distance(0, 1, {7, 7, 7}) == 0);
    bench.collapse(0, 1, {0, 0, 0});
}

TEST_CASE("boundary bindings: a simplified disc is nearly as close as a regular polygon") {
    const TriangleMesh disc = test::fan(128);
    Options options{.target = faces(16)};
    const SimplifyResult result = simplify(disc.view(), options);
    const double side_height = 1 - std::cos(test::pi / 16);
    CHECK(compare(disc.view(), result.mesh.view()).hausdorff <= 2 * side_height);
}
