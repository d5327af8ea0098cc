#include "faqem/engine/metric/accumulated.hpp"

#include "faqem/detail/simplify/presets.hpp"
#include "support/catch.hpp"
#include "support/meshes.hpp"

using namespace faqem;
using namespace faqem::engine;

namespace {

const double root2 = std::sqrt(2.0);

// Weights of Table 1 of the paper, for a mesh in engine units.
CompositeWeights paper_weights() {
    return {.base = BaseWeight::inverse_area, .boundary = 500, .normal = 0.01, .area = 100, .seam = 5000};
}

struct MetricBench {
    MetricBench(const TriangleMesh& mesh, const CompositeWeights& weights,
                std::vector<std::uint8_t> seams = {})
        : collapse_mesh(test::collapse_mesh_of(mesh)),
          pairs(collapse_mesh, {}),
          seam(std::move(seams)),
          metric(weights, seam) {
        metric.initialise(collapse_mesh, pairs);
    }
    std::optional<Candidate> evaluate(Index u, Index v,
                                      AllowedPosition allowed_position = AllowedPosition::anywhere) const {
        return metric.evaluate(collapse_mesh, pairs, test::pair_of(pairs, u, v), allowed_position);
    }
    PairTable::Change collapse(Index u, Index v, const Vector3& p) {
        metric.before_collapse(collapse_mesh, pairs, u, v, p);
        collapse_mesh.collapse(u, v, p);
        std::vector<Index> killed;
        std::vector<PairTable::Change> changes;
        pairs.merge(collapse_mesh, u, v, killed, changes);
        return changes.empty() ? PairTable::Change() : changes.front();
    }

    CollapseMesh collapse_mesh;
    PairTable pairs;
    std::vector<std::uint8_t> seam;
    AccumulatedMetric metric;
};

}  // namespace

TEST_CASE("accumulated: the vertex quadric is the sum of the base, boundary and normal terms") {
    // Paper, Sec. 3.2.1, at corner 0 of the unit square: two faces of area 1/2 give 4 z^2; the boundary has
    // a right angle there: 500 / sqrt 2 (z^2 + x^2); the tangent plane gives z^2 / 100.
    const MetricBench bench(test::quad(), paper_weights());
    const Quadric& q = bench.metric.quadric(0);
    CHECK(q({0, 0, 2}) == Approx(4 * (4 + 500 / root2 + 0.01)));
    CHECK(q({2, 0, 0}) == Approx(4 * 500 / root2));
    CHECK(q({0, 2, 0}) == Approx(0).margin(1e-12));
}

TEST_CASE("accumulated: a weight of 0 disables a term") {
    CompositeWeights w = paper_weights();
    w.boundary = w.normal = 0;
    const MetricBench bench(test::quad(), w);
    CHECK(bench.metric.quadric(0)({1, 1, 2}) == Approx(4 * 4));
    w.area = 0;
    CHECK(MetricBench(test::quad(), w).evaluate(0, 1)->cost == 0);
}

TEST_CASE("accumulated: the cost is the quadric at the chosen position plus the area term there") {
    // Paper eq. 2-4. Pair 0-1 of the unit square: 500 / sqrt 2 (x^2 + (x - 1)^2) without y is singular, and
    // the midpoint is best: 250 / sqrt 2. There the sides 0-3 and 1-2 cost 100 / 8 each, side 0-1 nothing.
    const MetricBench bench(test::quad(), paper_weights());
    const auto found = bench.evaluate(0, 1);
    REQUIRE(found);
    CHECK(found->point == Vector3(0.5, 0, 0));
    CHECK(found->cost == Approx(250 / root2 + 25));
}

TEST_CASE("accumulated: with before_placement the area term affects the position") {
    // Unit square, unit base weights: 3 z^2 and ((y^2 + z^2) + (x^2 + z^2) + ((1 - x)^2 + z^2)) / 2 for the
    // pair 0-1.
    CompositeWeights w{.area = 1, .area_term = AreaTerm::before_placement};
    const auto found = MetricBench(test::quad(), w).evaluate(0, 1);
    REQUIRE(found);
    CHECK((found->point - Vector3(0.5, 0, 0)).norm() < 1e-12);
    CHECK(found->cost == Approx(0.25));
}

TEST_CASE("accumulated: with after_placement the area term does not affect the position") {
    CHECK(MetricBench(test::quad(), {.area = 1e9}).evaluate(0, 1)->point == Vector3(0, 0, 0));
}

TEST_CASE("accumulated: the seam weight multiplies the whole initial quadric of a seam vertex") {
    // Paper, supplementary: w_uv.
    const MetricBench plain(test::quad(), paper_weights());
    const MetricBench seam(test::quad(), paper_weights(), {0, 1, 0, 0});
    const Vector3 p(1, 2, 3);
    CHECK(seam.metric.quadric(1)(p) == Approx(5000 * plain.metric.quadric(1)(p)));
    CHECK(seam.metric.quadric(0)(p) == plain.metric.quadric(0)(p));
}

TEST_CASE("accumulated: the allowed position is respected and nowhere gives no candidate") {
    const MetricBench bench(test::quad(), paper_weights());
    CHECK(bench.evaluate(0, 1, AllowedPosition::at_first)->point == Vector3(0, 0, 0));
    CHECK(bench.evaluate(0, 1, AllowedPosition::at_second)->point == Vector3(1, 0, 0));
    CHECK(bench.evaluate(0, 1, AllowedPosition::at_first)->cost == Approx(500 / root2 + 50));
    CHECK_FALSE(bench.evaluate(0, 1, AllowedPosition::nowhere));
}

TEST_CASE("accumulated: a cost that is not finite gives no candidate") {
    CHECK_FALSE(MetricBench(test::scaled(test::cube(), 1e200), paper_weights()).evaluate(0, 1));
}

TEST_CASE("accumulated: costs are never negative") {
    const TriangleMesh mesh = test::moved(test::grid(4), {0.1, 0.7, 1e5});
    const MetricBench bench(mesh, CompositeWeights());
    for (Index pair = 0; pair < bench.pairs.size(); ++pair)
        CHECK(bench.evaluate(bench.pairs.first(pair), bench.pairs.second(pair))->cost >= 0);
}

TEST_CASE("accumulated: the survivor of a collapse has the sum of both quadrics") {
    MetricBench bench(test::cube(), CompositeWeights());
    const Vector3 p(1, 2, 3);
    const double sum = bench.metric.quadric(0)(p) + bench.metric.quadric(1)(p);
    bench.collapse(0, 1, {0.5, 0, 0});
    CHECK(bench.metric.quadric(0)(p) == sum);
}

TEST_CASE("accumulated: the area term refers to the current boundary") {
    // Unit square, 1 merged into 0 at (1/2, 0, 0): the triangle 0 2 3 is left, whose edges are all boundary
    // edges.
    MetricBench bench(test::quad(), {.area = 1});
    bench.collapse(0, 1, {0.5, 0, 0});
    const auto found = bench.evaluate(2, 3, AllowedPosition::at_second);
    REQUIRE(found);
    // At 3 = (0, 1, 0) the sides 2-3 and 3-0 cost nothing; with side 2-0 it spans the triangle of area 1/2.
    CHECK(found->cost == Approx(2 * 0.25));
}

TEST_CASE("accumulated: only the area term changes costs of pairs without the survivor") {
    const PairTable::Change open{{1, 2}, true}, inner{{1, 2}, false};
    CompositeWeights w;
    CHECK(AccumulatedMetric(w).reevaluation(open) == Reevaluation::none);
    w.area = 1;
    CHECK(AccumulatedMetric(w).reevaluation(open) == Reevaluation::immediate);
    CHECK(AccumulatedMetric(w).reevaluation(inner) == Reevaluation::none);
}

TEST_CASE("accumulated: a tiny mesh far from the centre has the costs of the same mesh at the origin") {
    // A bumpy grid of size 2^-20 with a stray face, which makes the bounding box 2^6 or 2^20 times as large.
    const double size = 0x1p-20;
    const TriangleMesh grid = test::scaled(test::shaken(test::grid(6), 0.1, 5), size);
    const Vec3 far = {0.5, 0.25, -0.5};
    const TriangleMesh stray = test::make({{-1, 0, 0}, {-1, 1, 0}, {-1, 0, 1}}, {{0, 1, 2}});
    for (const BaseWeight base : {BaseWeight::unit, BaseWeight::area}) {
        CompositeWeights weights{.base = base};
        weights.area = weights.normal = weights.boundary = 1;
        MetricBench near(test::both(grid, test::scaled(stray, 64 * size)), weights);
        MetricBench together(test::both(test::moved(grid, far), stray), weights);
        const auto check = [&] {
            for (Index pair = 0; pair < near.pairs.size(); ++pair) {
                if (!near.pairs.is_alive(pair) || near.pairs.first(pair) >= grid.positions.size()) continue;
                const Index u = near.pairs.first(pair), v = near.pairs.second(pair);
                const auto a = near.evaluate(u, v), b = together.evaluate(u, v);
                REQUIRE(a.has_value() == b.has_value());
                CAPTURE(u, v);
                CHECK(b->cost == Approx(a->cost).epsilon(1e-4).margin(1e-12 * size * size));
                CHECK((b->point - to_eigen(far) - a->point).norm() < 1e-4 * size);
            }
        };
        check();
        for (const auto& [u, v] : {std::pair<Index, Index>{8, 9}, {16, 17}, {8, 16}}) {
            const auto a = near.evaluate(u, v);
            near.collapse(u, v, a->point);
            together.collapse(u, v, together.evaluate(u, v)->point);
        }
        check();
    }
}
