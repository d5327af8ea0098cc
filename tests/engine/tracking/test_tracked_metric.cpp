#include "faqem/engine/tracking/tracked_metric.hpp"

#include <catch2/catch.hpp>

#include "faqem/compare.hpp"
#include "faqem/simplify.hpp"
#include "support/original.hpp"

using namespace faqem;
using namespace faqem::engine;

namespace {

struct Bench {
    explicit Bench(const TriangleMesh& mesh, std::size_t target = 0)
        : original(mesh),
          collapse_mesh(original.positions, original.triangles),
          pairs(collapse_mesh, {}),
          metric({0, 0, 0}, original.surface, original.tracked, target ? target : mesh.triangles.size(),
                 collapse_mesh.area() / static_cast<double>(target ? target : mesh.triangles.size())) {
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
        return metric.exact_cost(collapse_mesh, pairs, u, v, candidate);
    }

    test::OriginalOf original;
    CollapseMesh collapse_mesh;
    PairTable pairs;
    TrackedMetric metric;
};

}  // namespace

TEST_CASE("tracked: a collapse costs the mean face area times the largest squared distance, besides") {
    // A pyramid over the unit square: apex 4 at height h joined with corner 0 leaves the flat square, from
    // which the apex is h away. Faces there would be: (0, 1, 2) and (0, 2, 3).
    const double h = 0.5;
    const TriangleMesh pyramid = test::make({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5, 0.5, h}},
                                            {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}});
    Bench bench(pyramid);
    const double face_area = 0.5 * std::sqrt(0.25 + h * h);
    const Candidate flat{{0, 0, 0}, 7};
    CHECK(bench.exact_cost(0, 4, flat) == Approx(7 + face_area * h * h));
}

TEST_CASE("tracked: the way back counts, from the new vertex to the original") {
    // A flat square with two vertices inside: they lifted by 1 leave all vertices on the surface there would
    // be, or near it; the new vertex is 1 away from the original.
    const TriangleMesh flat =
        test::make({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5, 0.5, 0}, {0.5, 0.25, 0}},
                   {{0, 1, 5}, {1, 4, 5}, {0, 5, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}});
    Bench bench(flat);
    const Candidate lifted{{0.5, 0.25, 1}, 0};
    CHECK(bench.exact_cost(4, 5, lifted) == Approx(1.0 / 6));
}

TEST_CASE("tracked: small errors in one direction add up") {
    // A strip bent into half a circle: after some collapses onto one vertex the distance from those that are
    // gone is counted, though the faces of today know nothing of them.
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
    Bench bench(strip);
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

TEST_CASE("tracked: where nothing is left around the pair the planes alone tell") {
    Bench bench(test::make({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}));
    CHECK(bench.exact_cost(0, 1, {{0.5, 0, 0}, 3}) == 3);
}

TEST_CASE("tracked: balanced comes closer to a bumpy sphere than fast, in the largest distance") {
    const TriangleMesh mesh = test::shaken(test::icosphere(4), 0.03, 5);
    const auto hausdorff = [&](Preset preset) {
        const SimplifyResult r = simplify(mesh.view(), {.target = ratio(0.1), .preset = preset});
        CHECK(r.mesh.triangles.size() <= mesh.triangles.size() / 10);
        return compare(mesh.view(), r.mesh.view(), {.samples = 20'000}).hausdorff;
    };
    CHECK(hausdorff(Preset::balanced) < hausdorff(Preset::fast));
}

TEST_CASE("tracked: far above the target planes and border tell, then the lineage what is bound where") {
    // A cylinder of 16 sides and 16 rings; four times the target is reached by joining a rim with the next.
    const TriangleMesh tube = test::cylinder(16, 16, 4);
    Bench bench(tube, 120);
    const Candidate in_place{bench.collapse_mesh.position(1), 0}, inside{bench.collapse_mesh.position(17), 0};
    REQUIRE(bench.collapse_mesh.face_count() > 480);
    CHECK(bench.exact_cost(17, 16, inside) == 0);
    CHECK(bench.exact_cost(1, 0, in_place) > 0);
    for (Index v = 0; bench.collapse_mesh.face_count() > 480; v += 2) {
        bench.collapse(v + 1, v, bench.collapse_mesh.position(v + 1));
    }
    // Vertex 0 went into 1 and is now as far from the surface as its arc is high over the chord from 15 to 1.
    const double height = 1 - std::cos(test::pi / 8);
    const double face_area = 2 * test::pi * 4 / 120;
    const double cost = bench.exact_cost(1, 17, in_place);
    CHECK(cost > 0.9 * face_area * height * height);
}

TEST_CASE("tracked: squared distances of the border count twice") {
    // The side 0 1 of a flat square becomes its middle: corners 0 and 1 stay on the surface's plane, but are
    // sqrt(1/5) away from the new sides. Only the middle of the square is inside.
    const TriangleMesh flat = test::make({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5, 0.5, 0}},
                                         {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}});
    Bench bench(flat);
    CHECK(bench.exact_cost(0, 1, {{0.5, 0, 0}, 3}) == Approx(3 + 2 * 0.25 / 5));
}
