#include "faqem/engine/engine.hpp"

#include <algorithm>
#include <map>

#include "support/catch.hpp"
#include "support/engine_script.hpp"
#include "support/meshes.hpp"
#include "support/naive.hpp"

using namespace faqem;
using namespace faqem::engine;
using namespace faqem::test;

namespace {

// Weights and rules of the presets, for a mesh in engine units.
struct PresetRules {
    CompositeWeights weights;
    Rules rules;
};

PresetRules qem_rules() { return {{}, {LinkCondition::on, 0, 0}}; }

PresetRules paper_rules() {
    return {{.base = BaseWeight::inverse_area, .boundary = 500, .normal = 0.01, .area = 100}, {}};
}

PresetRules stmw_rules() {
    return {{.base = BaseWeight::area, .area = 1, .area_term = AreaTerm::before_placement}, {}};
}

}  // namespace

TEST_CASE("engine: collapses agree with a brute-force implementation of the paper's algorithm") {
    const TriangleMesh meshes[] = {
        test::shaken(test::icosphere(1), 0.1, 1),
        test::shaken(test::grid(5), 0.2, 2),
        test::shaken(test::cylinder(8, 4, 2), 0.1, 3),
        test::shaken(test::torus(7, 5), 0.1, 4),
        test::both(test::shaken(test::grid(3), 0.2, 5), test::shaken(test::book(), 0.2, 6)),
        test::soup(7, 25, 40),
        test::soup(8, 40, 30)};
    for (const TriangleMesh& mesh : meshes) {
        for (const PresetRules& preset : {qem_rules(), paper_rules(), stmw_rules()}) {
            // On open meshes qem has several pairs of cost 0, whose order would depend on rounding.
            if (preset.rules.link == LinkCondition::on && !test::closed_manifold(mesh.triangles)) continue;
            const std::size_t target = mesh.triangles.size() / 5;
            const std::vector<Collapse> expected =
                test::Naive(mesh, preset.weights, preset.rules).run(target);
            Play<AccumulatedMetric> play(mesh, AccumulatedMetric(preset.weights));
            play.run(target, preset.rules);
            const CollapseHistory history = play.recorder.take();
            // After the collapses in `expected` the engine continues with the ladder.
            REQUIRE(history.collapses.size() >= expected.size());
            REQUIRE(expected.size() > 3);
            for (std::size_t k = 0; k < expected.size(); ++k) {
                const Collapse &found = history.collapses[k], &wanted = expected[k];
                INFO("collapse " << k << " of " << expected.size() << ", mesh of " << mesh.triangles.size()
                                 << " faces, area weight " << preset.weights.area);
                CAPTURE(found.first, found.second, wanted.first, wanted.second);
                CAPTURE(found.position, wanted.position);
                REQUIRE(ends(found.first, found.second) == ends(wanted.first, wanted.second));
                const Vector3 apart = to_eigen(found.position) - to_eigen(wanted.position);
                REQUIRE(apart.norm() <= 1e-5 * (1 + to_eigen(wanted.position).norm()));
            }
        }
    }
}

TEST_CASE("engine: on a flat hexagon qem takes the first equal pair, other metrics keep the boundary") {
    // All faces are in one plane. With qem every cost is 0, so that the pair of lowest index (0, 1) is
    // collapsed to the first of the equally good positions, the centre 0. The area term of the others is 0
    // only at the boundary vertex.
    const TriangleMesh hexagon = test::fan(6);
    Play<AccumulatedMetric> plain(hexagon, AccumulatedMetric(qem_rules().weights));
    CHECK(plain.run(4, qem_rules().rules).collapses == 1);
    const CollapseHistory history = plain.recorder.take();
    CHECK(history.collapses[0].first == 0);
    CHECK(history.collapses[0].second == 1);
    CHECK(history.collapses[0].position == Vec3{0, 0, 0});
    for (const PresetRules& preset : {paper_rules(), stmw_rules()}) {
        Play<AccumulatedMetric> play(hexagon, AccumulatedMetric(preset.weights));
        CHECK(play.run(4, preset.rules).collapses == 1);
        const Collapse first = play.recorder.take().collapses.at(0);
        REQUIRE(std::min(first.first, first.second) == 0);
        const Vector3 rim = to_eigen(hexagon.positions[std::max(first.first, first.second)]);
        CHECK((to_eigen(first.position) - rim).norm() < 1e-9);
        double area = 0;
        for (Index f = 0; f < play.collapse_mesh.face_slots(); ++f) {
            if (play.collapse_mesh.is_alive(f)) area += play.collapse_mesh.area_vector(f).z() / 2;
        }
        CHECK(area == Approx(1.5 * std::sqrt(3.0)));
    }
}

TEST_CASE("engine: the cheapest pair is collapsed first and the loop stops at the target") {
    Play<Script> play(test::grid(2),
                      Script({{{0, 1}, {0.5, 0, 0}}, {{3, 4}, {0.5, 1, 0}}, {{6, 7}, {0.5, 2, 0}}}));
    const LoopResult& result = play.run(5, {LinkCondition::off, 0, 0});
    CHECK(result.stop == StopReason::reached_target);
    CHECK(result.collapses == 2);
    const CollapseHistory history = play.recorder.take();
    CHECK(ends(history.collapses[0].first, history.collapses[0].second) == Ends(0, 1));
    CHECK(play.collapse_mesh.face_count() == 5);
    CHECK(result.rungs == decltype(result.rungs){});
}

namespace {

// As Script, but the exact cost of some pairs is higher.
struct CostlierExact : Script {
    static constexpr bool has_exact_cost = true;

    std::map<Ends, double> real;
    double exact_cost(const CollapseMesh&, const PairTable& pairs, Index pair, const Candidate& candidate) {
        const auto at = real.find(ends(pairs.first(pair), pairs.second(pair)));
        return at == real.end() ? candidate.cost : at->second;
    }
};
static_assert(CollapseMetric<CostlierExact> && CollapseMetric<Script> && !Script::has_exact_cost);

}  // namespace

TEST_CASE("engine: a pair with a higher exact cost than the next one is requeued") {
    CostlierExact script;
    script.offers = {{{0, 1}, {0.5, 0, 0}}, {{3, 4}, {0.5, 1, 0}}, {{6, 7}, {0.5, 2, 0}}};
    script.real = {{{0, 1}, 1.5}};  // the costs are 0, 1 and 2, so that it becomes the second
    Play<CostlierExact> play(test::grid(2), script);
    CHECK(play.run(5, {LinkCondition::off, 0, 0}).collapses == 2);
    const CollapseHistory history = play.recorder.take();
    CHECK(ends(history.collapses[0].first, history.collapses[0].second) == Ends(3, 4));
    CHECK(ends(history.collapses[1].first, history.collapses[1].second) == Ends(0, 1));
}

TEST_CASE("engine: the only pair is collapsed regardless of its exact cost") {
    CostlierExact script;
    script.offers = {{{0, 1}, {0.5, 0, 0}}};
    script.real = {{{0, 1}, 1e9}};
    Play<CostlierExact> play(test::grid(2), script);
    CHECK(play.run(7, {LinkCondition::off, 0, 0}).collapses == 1);
}

TEST_CASE("engine: a locked vertex does not move and a pair of two locked vertices is not collapsed") {
    Play<Script> play(test::grid(2), Script({{{0, 1}, {0.5, 0, 0}}, {{1, 2}, {1.5, 0, 0}}}));
    play.locked = {1, 1, 0, 0, 0, 0, 0, 0, 0};
    const LoopResult& result = play.run(1, {LinkCondition::off, 0, 0});
    CHECK(result.collapses == 1);
    CHECK(refused(result, Refusal::locked) > 0);
    CHECK(play.collapse_mesh.position(1) == Vector3(1, 0, 0));
    const CollapseHistory history = play.recorder.take();
    CHECK(ends(history.collapses[0].first, history.collapses[0].second) == Ends(1, 2));
    CHECK(history.collapses[0].position == Vec3{1, 0, 0});
}

TEST_CASE("engine: the collapse of a virtual pair connects two components") {
    const TriangleMesh mesh = test::both(test::quad(), test::moved(test::quad(), {1.5, 0, 0}));
    const std::vector<Ends> extra = {{1, 4}};
    Play<Script> play(mesh, Script({{{1, 4}, {1.25, 0, 0}}, {{2, 3}, {0.5, 1, 0}}}), extra);
    CHECK(play.run(3, {LinkCondition::off, 0, 0}).collapses == 2);
    CHECK(components(play.collapse_mesh).size() == 1);
}

TEST_CASE("engine: the last faces are not collapsed") {
    Script script;
    for (Index u = 0; u < 4; ++u) {
        for (Index v = u + 1; v < 4; ++v) script.offers[{u, v}] = {0.5, 0.5, 0.25};
    }
    Play<Script> play(test::quad(), script);
    const LoopResult& result = play.run(0, {LinkCondition::off, 0, 0});
    CHECK(result.stop == StopReason::no_legal_collapse);
    CHECK(play.collapse_mesh.face_count() > 0);
    CHECK(refused(result, Refusal::last_faces) > 0);
}

TEST_CASE("engine: the last face with an area is not collapsed while degenerate faces are left") {
    Script script;
    script.offers = {{{1, 2}, {4, 0, 0}}, {{3, 4}, {2, 0, 0}}};
    // Two faces of zero area are at the edge (0, 1).
    Play<Script> play(test::make({{0, 0, 0}, {4, 0, 0}, {0, 3, 0}, {2, 0, 0}, {1, 0, 0}},
                                 {{0, 1, 2}, {1, 0, 3}, {3, 0, 4}}),
                      script);
    const LoopResult& result = play.run(2, {LinkCondition::off, 0, 0});
    CHECK(result.stop == StopReason::reached_target);
    CHECK(refused(result, Refusal::last_faces) == 1);
    CHECK(play.collapse_mesh.is_alive(0));
}

TEST_CASE("engine: the cost of closing a boundary loop includes its distance to the next loop") {
    // A ring between a triangle of side 4 and a triangular hole 3 4 5 of side 1. The vertices of the hole
    // are 5 at (0, 0.5), 3 at (-0.5, -0.5) and 4 at (0.5, -0.5); the outer corner nearest to 3 has distance
    // sqrt(4.5). Squares beside the ring offer collapses of cost 1, 2 and 3.
    const TriangleMesh ring =
        test::make({{-2, -2, 0}, {2, -2, 0}, {0, 2, 0}, {-0.5, -0.5, 0}, {0.5, -0.5, 0}, {0, 0.5, 0}},
                   {{0, 1, 3}, {1, 4, 3}, {1, 2, 4}, {2, 5, 4}, {2, 0, 5}, {0, 3, 5}});
    const auto order_of_hole = [&](double distance_weight) {
        Script script;
        script.offers[{3, 4}] = {0.1, -0.5, 0};
        TriangleMesh mesh = ring;
        for (Index i = 0; i < 3; ++i) {
            const Index first = 6 + 4 * i;
            mesh = test::both(mesh, test::moved(test::quad(), {100, 10.0 * i, 0}));
            script.offers[{first, first + 1}] = engine::to_eigen(mesh.positions[first]);
        }
        Play<Script> play(mesh, script);
        play.run(9, {LinkCondition::off, -1, 0, -1}, 0, distance_weight);
        const CollapseHistory history = play.recorder.take();
        std::size_t at = 0;
        while (at < history.collapses.size() && history.collapses[at].first > 5) ++at;
        return at;
    };
    // The script's costs are 0 for the hole, then 1, 2 and 3 for the squares.
    CHECK(order_of_hole(0) == 0);
    CHECK(order_of_hole(1.5 / 4.5) == 1);
    CHECK(order_of_hole(2.5 / 4.5) == 2);
}
