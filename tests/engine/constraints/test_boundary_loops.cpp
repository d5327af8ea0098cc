#include "faqem/engine/constraints/boundary_loops.hpp"

#include <cmath>

#include "support/catch.hpp"
#include "support/meshes.hpp"

using namespace faqem;
using namespace faqem::engine;

namespace {

struct LoopsBench {
    explicit LoopsBench(const TriangleMesh& mesh)
        : collapse_mesh(test::collapse_mesh_of(mesh)),
          pairs(collapse_mesh, {}),
          loops(collapse_mesh, pairs) {}

    Index pair(Index u, Index v) const { return test::pair_of(pairs, u, v); }
    double squared_distance(Index u, Index v) {
        return loops.squared_distance(collapse_mesh, pairs, u, v, pair(u, v));
    }
    void collapse(Index u, Index v) {
        loops.before_collapse(pairs, u, v, pair(u, v));
        collapse_mesh.collapse(u, v, collapse_mesh.position(u));
        std::vector<Index> killed;
        std::vector<PairTable::Change> changes;
        pairs.merge(collapse_mesh, u, v, killed, changes);
        loops.after_collapse(collapse_mesh, pairs, u);
    }

    CollapseMesh collapse_mesh;
    PairTable pairs;
    BoundaryLoops loops;
};

// A triangle in the plane x, whose first vertex is on the x axis and nearest to the other triangles.
TriangleMesh triangle_at(double x) { return test::make({{x, 0, 0}, {x, 0.1, 0}, {x, 0, 0.1}}, {{0, 1, 2}}); }

}  // namespace

TEST_CASE("boundary loops: the error of closing a hole is its distance to the outer loop") {
    // A ring of six faces between the triangle 0 1 2 and the hole 3 4 5.
    const TriangleMesh ring =
        test::make({{-2, -2, 0}, {2, -2, 0}, {0, 2, 0}, {-0.5, -0.5, 0}, {0.5, -0.5, 0}, {0, 0.5, 0}},
                   {{0, 1, 3}, {1, 4, 3}, {1, 2, 4}, {2, 5, 4}, {2, 0, 5}, {0, 3, 5}});
    LoopsBench bench(ring);
    CHECK(bench.squared_distance(3, 4) == Approx(4.5));  // from 3 to 0
    CHECK(bench.squared_distance(0, 3) == 0);            // the two loops are merged
    CHECK(bench.squared_distance(1, 4) == 0);
    bench.collapse(3, 4);
    // No other loop is left: the diagonal counts, plus the distance of the closed hole.
    const double diagonal = std::sqrt(4 * 4 + 4 * 4);
    CHECK(bench.squared_distance(0, 1) == Approx(std::pow(diagonal + std::sqrt(4.5), 2)));
}

TEST_CASE("boundary loops: a hole of four edges does not vanish with its first collapse") {
    // The middle square of 3 x 3 is missing.
    TriangleMesh frame = test::grid(3);
    frame.triangles.erase(frame.triangles.begin() + 8, frame.triangles.begin() + 10);
    LoopsBench bench(frame);
    CHECK(bench.squared_distance(5, 6) == 0);
    bench.collapse(5, 6);
    CHECK(bench.squared_distance(5, 10) > 0);
}

TEST_CASE("boundary loops: the distances of loops that vanish one after the other add up") {
    LoopsBench bench(test::both(test::both(triangle_at(0), triangle_at(1)), triangle_at(3)));
    CHECK(bench.squared_distance(0, 1) == Approx(1));
    CHECK(bench.squared_distance(3, 4) == Approx(1));
    CHECK(bench.squared_distance(6, 7) == Approx(4));
    bench.collapse(0, 1);
    CHECK(bench.squared_distance(3, 4) == Approx(9));  // 1 from the first triangle to it, plus 2
    CHECK(bench.squared_distance(6, 7) == Approx(4));
    bench.collapse(3, 4);
    CHECK(bench.squared_distance(6, 7) > 9);
}

TEST_CASE("boundary loops: removing two back-to-back faces at a non-manifold edge can start a loop") {
    // Each side of the triangle 0 1 2 has two more faces, back to back: it has three faces and is not a
    // boundary edge.
    TriangleMesh flaps =
        test::make({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}},
                   {{0, 1, 2}, {0, 1, 3}, {1, 0, 3}, {1, 2, 4}, {2, 1, 4}, {2, 0, 5}, {0, 2, 5}});
    LoopsBench bench(flaps);
    CHECK(bench.squared_distance(0, 3) == Approx(3));  // there is no loop yet: the diagonal
    bench.collapse(0, 3);
    CHECK(bench.squared_distance(1, 4) == 0);  // adjacent to the loop that was started
}

TEST_CASE("boundary loops: collapses of a closed surface have no error") {
    LoopsBench bench(test::icosphere(1));
    for (Index pair = 0; pair < bench.pairs.size(); ++pair) {
        CHECK(bench.squared_distance(bench.pairs.first(pair), bench.pairs.second(pair)) == 0);
    }
}
