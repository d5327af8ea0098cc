#include "faqem/engine/tracking/tracked_metric.hpp"

#include <cmath>

#include "faqem/compare.hpp"
#include "faqem/simplify.hpp"
#include "support/catch.hpp"
#include "support/meshes.hpp"
#include "support/original.hpp"

using namespace faqem;
using namespace faqem::engine;

namespace {

struct TrackedBench {
    explicit TrackedBench(const TriangleMesh& mesh, std::size_t target = 0, DistanceLimit limit = {})
        : original(mesh),
          collapse_mesh(original.positions, original.triangles),
          pairs(collapse_mesh, {}),
          metric({0, 0, 0}, original.surface, original.tracked, target ? target : mesh.triangles.size(),
                 collapse_mesh.area() / static_cast<double>(target ? target : mesh.triangles.size()), nullptr,
                 RunContext::endless(), std::move(limit)) {
        metric.initialise(collapse_mesh, pairs);
    }
    void collapse(Index u, Index v, const Vector3& p) {
        std::vector<Index> killed;
        std::vector<PairTable::Change> changes;
        metric.before_collapse(collapse_mesh, pairs, u, v, p);
        collapse_mesh.collapse(u, v, p);
        pairs.merge(collapse_mesh, u, v, killed, changes);
        metric.after_collapse(collapse_mesh, pairs, u, changes);
    }

    double exact_cost(Index u, Index v, const Candidate& candidate) {
        return metric.exact_cost(collapse_mesh, pairs, test::pair_of(pairs, u, v), candidate);
    }

    test::OriginalOf original;
    CollapseMesh collapse_mesh;
    PairTable pairs;
    TrackedMetric metric;
};

// A pyramid on the unit square. Collapsing the apex 4, at height h, to corner 0 leaves the faces (0, 1, 2) and
// (0, 2, 3), from which the apex has distance h.
TriangleMesh pyramid(double h) {
    return test::make({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5, 0.5, h}},
                      {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}});
}

}  // namespace

TEST_CASE("tracked metric: the mean face area times the largest squared distance is added to the cost") {
    const double h = 0.5;
    TrackedBench bench(pyramid(h));
    const double face_area = 0.5 * std::sqrt(0.25 + h * h);
    const Candidate flat{{0, 0, 0}, 7};
    CHECK(bench.exact_cost(0, 4, flat) == Approx(7 + face_area * h * h));
}

TEST_CASE("tracked metric: the distance from the new vertex to the original is measured, too") {
    // A plane square with two inner vertices. If they are collapsed to a point at height 1, all original
    // vertices are on or near the new faces, but the new vertex has distance 1 from the original.
    const TriangleMesh flat =
        test::make({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5, 0.5, 0}, {0.5, 0.25, 0}},
                   {{0, 1, 5}, {1, 4, 5}, {0, 5, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}});
    TrackedBench bench(flat);
    const Candidate lifted{{0.5, 0.25, 1}, 0};
    CHECK(bench.exact_cost(4, 5, lifted) == Approx(1.0 / 6));
}

TEST_CASE("tracked metric: a collapse that leaves a vertex beyond the limit is refused") {
    const Candidate flat{{0, 0, 0}, 7};
    const auto is_near = [](const Vector3&) { return true; };
    CHECK(std::isinf(TrackedBench(pyramid(0.5), 0, {0.49, 0, is_near}).exact_cost(0, 4, flat)));
    CHECK(std::isfinite(TrackedBench(pyramid(0.5), 0, {0.51, 0, is_near}).exact_cost(0, 4, flat)));
}

TEST_CASE("tracked metric: a collapse with a point of a new face beyond the limit is refused") {
    // Of the centroids and the middles of the sides at corner 0, the centroid of (0, 1, 2) is at the largest x, 2/3.
    const Candidate flat{{0, 0, 0}, 7};
    for (const double most : {0.66, 0.67}) {
        TrackedBench bench(pyramid(0.5), 0, {1, 0, [&](const Vector3& p) { return p.x() <= most; }});
        REQUIRE(std::isfinite(bench.exact_cost(0, 4, flat)));
        CHECK(bench.metric.exceeds_limit(flat) == (most < 2.0 / 3));
    }
}

TEST_CASE("tracked metric: without tracking, the limit is compared with the cost per area around the pair") {
    // The area is the square root of two.
    const Candidate flat{{0, 0, 0}, 7};
    const double limit = std::sqrt(7 / std::sqrt(2)) / 0.5;
    CHECK(std::isinf(TrackedBench(pyramid(0.5), 0, {0.99 * limit, 0.5, {}}).exact_cost(0, 4, flat)));
    CHECK(TrackedBench(pyramid(0.5), 0, {1.01 * limit, 0.5, {}}).exact_cost(0, 4, flat) == 7);
}

TEST_CASE("tracked metric: small errors in one direction add up") {
    // A strip bent into half a circle. After several collapses onto one vertex, the distance from the
    // removed vertices counts, although the current faces do not contain them.
    TriangleMesh strip;
    const int n = 8;
    for (int i = 0; i <= n; ++i) {
        const double a = test::pi * i / n;
        for (const double z : {0.0, 1.0}) strip.positions.push_back({std::cos(a), std::sin(a), z});
    }
    for (Index i = 0; i < 2 * n; i += 2) {
        strip.triangles.push_back({i, i + 2, i + 1});
        strip.triangles.push_back({i + 1, i + 2, i + 3});
    }
    TrackedBench bench(strip);
    const Index end = 0;
    double last = 0;
    for (Index next = 2; next < 8; next += 2) {
        const Candidate there{bench.collapse_mesh.position(end), 0};
        const double cost = bench.exact_cost(end, next, there);
        CHECK(cost > last);
        last = cost;
        bench.collapse(end, next, there.point);
    }
}

TEST_CASE("tracked metric: costs are the same whether or not they were asked for before a collapse") {
    const TriangleMesh mesh = test::shaken(test::icosphere(2), 0.05, 1);
    TrackedBench asked(mesh), fresh(mesh);
    const auto costs = [](TrackedBench& bench) {
        std::vector<double> all;
        for (Index pair = 0; pair < bench.pairs.size(); ++pair) {
            if (!bench.pairs.is_alive(pair)) continue;
            const Index u = bench.pairs.first(pair), v = bench.pairs.second(pair);
            all.push_back(bench.exact_cost(u, v, {bench.collapse_mesh.position(u), 0}));
        }
        return all;
    };
    for (Index v = 0; v < 5; ++v) {
        CHECK(costs(asked) == costs(asked));
        Index neighbour = no_index;
        asked.pairs.for_each_pair(v, [&](Neighbour n) { neighbour = n.vertex; });
        for (TrackedBench* bench : {&asked, &fresh})
            bench->collapse(v, neighbour, bench->collapse_mesh.position(neighbour));
    }
    CHECK(costs(asked) == costs(fresh));
}

TEST_CASE("tracked metric: without faces around the pair the cost is that of the planes") {
    TrackedBench bench(test::make({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}));
    CHECK(bench.exact_cost(0, 1, {{0.5, 0, 0}, 3}) == 3);
}

TEST_CASE("tracked metric: balanced has a Hausdorff distance a twentieth smaller than fast, on average") {
    double balanced = 0, fast = 0;
    for (const unsigned seed : {5, 6, 7, 8, 9, 10, 11, 12}) {
        const TriangleMesh mesh = test::shaken(test::icosphere(4), 0.03, seed);
        const auto hausdorff = [&](Preset preset) {
            const SimplifyResult r = simplify(mesh.view(), {.target = ratio(0.1), .preset = preset});
            CHECK(r.mesh.triangles.size() <= mesh.triangles.size() / 10);
            return compare(mesh.view(), r.mesh.view(), {.samples = 20'000}).hausdorff;
        };
        balanced += hausdorff(Preset::balanced), fast += hausdorff(Preset::fast);
    }
    CHECK(balanced < 0.95 * fast);
}

TEST_CASE("tracked metric: far above the target only boundaries are tracked, then all vertices") {
    // A cylinder of 16 sides and 16 rings. Three times the target is reached by collapses along the
    // boundaries.
    const TriangleMesh tube = test::cylinder(16, 16, 4);
    TrackedBench bench(tube, 160);
    const Candidate in_place{bench.collapse_mesh.position(1), 0}, inside{bench.collapse_mesh.position(17), 0};
    REQUIRE(bench.collapse_mesh.face_count() > 480);
    CHECK(bench.exact_cost(17, 16, inside) == 0);
    CHECK(bench.exact_cost(1, 0, in_place) > 0);
    for (Index v = 0; bench.collapse_mesh.face_count() > 480; v += 2) {
        bench.collapse(v + 1, v, bench.collapse_mesh.position(v + 1));
    }
    // Vertex 0 was merged into 1. Its distance from the surface is the height of its arc above the chord
    // from 15 to 1.
    const double height = 1 - std::cos(test::pi / 8);
    const double face_area = 2 * test::pi * 4 / 160;
    const double cost = bench.exact_cost(1, 17, in_place);
    CHECK(cost > 0.9 * face_area * height * height);
}

TEST_CASE("tracked metric: squared boundary distances count twice") {
    // The side (0, 1) of a plane square is collapsed to its midpoint. Corners 0 and 1 stay in the plane of
    // the faces, but have distance sqrt(1/5) from the new sides. Only the centre of the square is an inner
    // vertex.
    const TriangleMesh flat = test::make({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5, 0.5, 0}},
                                         {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}});
    TrackedBench bench(flat);
    CHECK(bench.exact_cost(0, 1, {{0.5, 0, 0}, 3}) == Approx(3 + 2 * 0.25 / 5));
}
