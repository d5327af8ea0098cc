#include "faqem/engine/engine.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <map>

#include "core/meshes.hpp"
#include "core/naive.hpp"

using namespace faqem;
using namespace faqem::engine;

namespace {

using Ends = std::pair<Index, Index>;

Ends ends(Index a, Index b) { return std::minmax(a, b); }

std::uint64_t taken(const LoopResult& result, Rung rung) {
    return result.rungs[static_cast<std::size_t>(rung)];
}
std::uint64_t refused(const LoopResult& result, Refusal why) {
    return result.refusals[static_cast<std::size_t>(why)];
}

// A metric that offers what the test says: a point for each pair of original vertices, cost by order.
struct Script {
    std::map<Ends, Vector3> offers;

    void initialise(const Complex&, const PairTable&) {}
    std::optional<Candidate> evaluate(const Complex& complex, const PairTable&, Index u, Index v,
                                      Freedom freedom) const {
        const auto at = offers.find(ends(u, v));
        if (at == offers.end() || freedom == Freedom::nowhere) return std::nullopt;
        const auto order = static_cast<double>(std::distance(offers.begin(), at));
        if (freedom == Freedom::at_first) return Candidate{complex.position(u), order};
        if (freedom == Freedom::at_second) return Candidate{complex.position(v), order};
        return Candidate{at->second, order};
    }
    void collapsing(const Complex&, const PairTable&, Index, Index, const Vector3&) {}
    void collapsed(const Complex&, const PairTable&, Index, std::span<const PairTable::Change>) {}
    Staleness staleness(const PairTable::Change&) const { return Staleness::none; }
};

// A run of the engine over a mesh, with everything that it changed.
template <class Metric>
struct Play {
    Play(const TriangleMesh& mesh, Metric m, const std::vector<Ends>& extra = {})
        : complex(test::complex_of(mesh)),
          pairs(complex, extra),
          locked(mesh.positions.size(), 0),
          metric(std::move(m)),
          recorder(complex) {}

    const LoopResult& run(std::size_t target, const Rules& rules, double tiny = 0,
                          double distance_weight = 0) {
        LoopOptions options;
        options.target_faces = target;
        options.rules = rules;
        options.tiny_component = tiny;
        options.distance_weight = distance_weight;
        Engine<Metric, HeapQueue, HistoryRecorder> engine(complex, pairs, wedges, locked, metric, recorder);
        return result = engine.run(options);
    }

    Complex complex;
    PairTable pairs;
    Wedges wedges;
    std::vector<std::uint8_t> locked;
    Metric metric;
    HistoryRecorder recorder;
    LoopResult result;
};

// Triangle 0 1 2 stays, vertex 2 is joined with 3; the new point turns it about the x axis.
const TriangleMesh hinge = test::make({{0, 0, 0}, {2, 0, 0}, {1, 1, 0}, {3, 1, 0}}, {{0, 1, 2}, {1, 3, 2}});

Script turn_hinge(double degrees) {
    const double a = degrees * test::pi / 180;
    return {{{{2, 3}, {1, std::cos(a), std::sin(a)}}}};
}

// The presets at the size the mesh has.
struct Named {
    CompositeWeights weights;
    Rules rules;
};

Named qem() { return {{}, {LinkCondition::on, 0, 0}}; }

Named paper() {
    Named n;
    n.weights.base = BaseWeight::inverse_area;
    n.weights.boundary = 500;
    n.weights.normal = 0.01;
    n.weights.area = 100;
    return n;
}

Named stmw() {
    Named n;
    n.weights.base = BaseWeight::area;
    n.weights.area = 1;
    n.weights.area_term = AreaTerm::before_placement;
    return n;
}

}  // namespace

TEST_CASE("the collapses are those of the paper's algorithm, done from its equations without any structure") {
    const TriangleMesh meshes[] = {
        test::shaken(test::icosphere(1), 0.1, 1),
        test::shaken(test::grid(5), 0.2, 2),
        test::shaken(test::cylinder(8, 4, 2), 0.1, 3),
        test::shaken(test::torus(7, 5), 0.1, 4),
        test::both(test::shaken(test::grid(3), 0.2, 5), test::shaken(test::book(), 0.2, 6)),
        test::soup(7, 25, 40),
        test::soup(8, 40, 30)};
    for (const TriangleMesh& mesh : meshes) {
        for (const Named& preset : {qem(), paper(), stmw()}) {
            // At the corner of a border qem has pairs that cost nothing, and rounding would choose.
            if (preset.rules.link == LinkCondition::on && !test::closed_manifold(mesh.triangles)) continue;
            const std::size_t target = mesh.triangles.size() / 5;
            const std::vector<Collapse> expected =
                test::Naive(mesh, preset.weights, preset.rules).run(target);
            Play<MemoryMetric> play(mesh, MemoryMetric(preset.weights));
            play.run(target, preset.rules);
            const CollapseHistory history = play.recorder.take();
            // Beyond `expected` the engine climbs its ladder.
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

TEST_CASE("on a flat hexagon qem takes the first of equal pairs, the others keep the rim") {
    // All planes are one: in qem every cost is 0, the pair of lowest index is hub and vertex 1, and of
    // equally good places the first end, the hub, is taken. The area term of both others is 0 only at the rim
    // vertex.
    const TriangleMesh hexagon = test::fan(6);
    Play<MemoryMetric> plain(hexagon, MemoryMetric(qem().weights));
    CHECK(plain.run(4, qem().rules).collapses == 1);
    const CollapseHistory history = plain.recorder.take();
    CHECK(history.collapses[0].first == 0);
    CHECK(history.collapses[0].second == 1);
    CHECK(history.collapses[0].position == Vec3{0, 0, 0});
    for (const Named& preset : {paper(), stmw()}) {
        Play<MemoryMetric> play(hexagon, MemoryMetric(preset.weights));
        CHECK(play.run(4, preset.rules).collapses == 1);
        const Collapse first = play.recorder.take().collapses.at(0);
        REQUIRE(std::min(first.first, first.second) == 0);
        const Vector3 rim = to_eigen(hexagon.positions[std::max(first.first, first.second)]);
        CHECK((to_eigen(first.position) - rim).norm() < 1e-9);
        double area = 0;
        for (Index f = 0; f < play.complex.face_slots(); ++f) {
            if (play.complex.alive(f)) area += play.complex.area_vector(f).z() / 2;
        }
        CHECK(area == Approx(1.5 * std::sqrt(3.0)));
    }
}

TEST_CASE("the cheapest pair goes first, and the loop ends at the target") {
    Script script;
    script.offers = {{{0, 1}, {0.5, 0, 0}}, {{3, 4}, {0.5, 1, 0}}, {{6, 7}, {0.5, 2, 0}}};
    Play<Script> play(test::grid(2), script);
    const LoopResult& result = play.run(5, {LinkCondition::off, 0, 0});
    CHECK(result.stop == StopReason::reached_target);
    CHECK(result.collapses == 2);
    const CollapseHistory history = play.recorder.take();
    CHECK(ends(history.collapses[0].first, history.collapses[0].second) == Ends(0, 1));
    CHECK(play.complex.face_count() == 5);
    CHECK(result.rungs == decltype(result.rungs){});
}

namespace {

// As Script, but some pairs turn out dearer when it comes to it.
struct Surprise : Script {
    std::map<Ends, double> real;
    double refine(const Complex&, const PairTable&, Index u, Index v, const Candidate& candidate) {
        const auto at = real.find(ends(u, v));
        return at == real.end() ? candidate.cost : at->second;
    }
};
static_assert(RefiningMetric<Surprise> && !RefiningMetric<Script>);

}  // namespace

TEST_CASE("a pair that turns out dearer than the next one waits for its turn") {
    Surprise script;
    script.offers = {{{0, 1}, {0.5, 0, 0}}, {{3, 4}, {0.5, 1, 0}}, {{6, 7}, {0.5, 2, 0}}};
    script.real = {{{0, 1}, 1.5}};  // the costs are 0, 1 and 2: it comes second now
    Play<Surprise> play(test::grid(2), script);
    CHECK(play.run(5, {LinkCondition::off, 0, 0}).collapses == 2);
    const CollapseHistory history = play.recorder.take();
    CHECK(ends(history.collapses[0].first, history.collapses[0].second) == Ends(3, 4));
    CHECK(ends(history.collapses[1].first, history.collapses[1].second) == Ends(0, 1));
}

TEST_CASE("a pair that is the last one goes, however dear it is") {
    Surprise script;
    script.offers = {{{0, 1}, {0.5, 0, 0}}};
    script.real = {{{0, 1}, 1e9}};
    Play<Surprise> play(test::grid(2), script);
    CHECK(play.run(7, {LinkCondition::off, 0, 0}).collapses == 1);
}

TEST_CASE("the ladder allows flips to -1/2, then all of them, each step counted") {
    Play<Script> gentle(hinge, turn_hinge(80));
    CHECK(gentle.run(1, {LinkCondition::off, 0, 0}).rungs == decltype(LoopResult::rungs){});
    Play<Script> half(hinge, turn_hinge(100));
    const LoopResult& first = half.run(1, {LinkCondition::off, 0, 0});
    CHECK(first.stop == StopReason::reached_target);
    CHECK(taken(first, Rung::reseed) == 1);
    CHECK(taken(first, Rung::without_link) == 0);
    CHECK(taken(first, Rung::flip_half) == 1);
    CHECK(taken(first, Rung::flip_any) == 0);
    CHECK(refused(first, Refusal::flip) == 2);
    Play<Script> any(hinge, turn_hinge(150));
    const LoopResult& second = any.run(1, {LinkCondition::off, 0, 0});
    CHECK(second.stop == StopReason::reached_target);
    CHECK(taken(second, Rung::flip_half) == 1);
    CHECK(taken(second, Rung::flip_any) == 1);
    CHECK(refused(second, Refusal::flip) == 3);
}

TEST_CASE("the ladder lifts the link condition before it allows flips") {
    // The diagonal of a square, joined in its middle: two more faces are there, so that something is left.
    TriangleMesh mesh = test::both(test::quad(), test::moved(test::quad(), {5, 0, 0}));
    Script script;
    script.offers = {{{0, 2}, {0.5, 0.5, 0}}};
    Play<Script> play(mesh, script);
    const LoopResult& result = play.run(2, {LinkCondition::on, 0, 0});
    CHECK(result.stop == StopReason::reached_target);
    CHECK(taken(result, Rung::reseed) == 1);
    CHECK(taken(result, Rung::without_link) == 1);
    CHECK(taken(result, Rung::flip_half) == 0);
    CHECK(refused(result, Refusal::link) == 2);
}

namespace {

// What the mesh of vertices 0 to 4 offers comes after so many collapses of the squares beside it, whose costs
// are 1, 2, 3 and 4; its own is 0.
std::size_t squares_before(TriangleMesh mesh, Script script, std::size_t target, const Rules& rules,
                           Rung rung, double distance_weight = 0) {
    for (Index i = 0; i < 4; ++i) {
        const Index first = 5 + 4 * i;
        mesh = test::both(mesh, test::moved(test::quad(), {5.0 * (i + 1), 0, 0}));
        script.offers[{first, first + 1}] = engine::to_eigen(mesh.positions[first]);
    }
    Play<Script> play(mesh, script);
    play.run(target, rules, 0, distance_weight);
    const CollapseHistory history = play.recorder.take();
    const auto is_own = [](const Collapse& c) { return std::max(c.first, c.second) <= 4; };
    const auto found = std::find_if(history.collapses.begin(), history.collapses.end(), is_own);
    CHECK(taken(play.result, rung) == 1);
    return static_cast<std::size_t>(found - history.collapses.begin());
}

}  // namespace

TEST_CASE(
    "by size, the link condition holds a pair until collapses cost more than its length to the fourth") {
    // Two tetrahedra on one triangle 0 1 2: joining two of its corners would leave double faces.
    const auto order_of_neck = [](double length, LinkCondition link) {
        const TriangleMesh neck =
            test::make({{0, 0, 0}, {1, 0, 0}, {0.5, 1, 0}, {0.5, 0.4, 1}, {0.5, 0.4, -1}},
                       {{0, 1, 3}, {1, 2, 3}, {2, 0, 3}, {1, 0, 4}, {2, 1, 4}, {0, 2, 4}});
        Script script;
        script.offers[{0, 1}] = {0.5 * length, 0, 0};
        return squares_before(test::scaled(neck, length), script, 8, {link, -1, 0}, Rung::without_link);
    };
    // 0.5^4 < 1 < 1.1^4 < 2 < 1.3^4 < 3
    CHECK(order_of_neck(0.5, LinkCondition::by_size) == 0);
    CHECK(order_of_neck(1.1, LinkCondition::by_size) == 1);
    CHECK(order_of_neck(1.3, LinkCondition::by_size) == 2);
    CHECK(order_of_neck(0.5, LinkCondition::on) == 4);
}

TEST_CASE("by size, a fold is put off until collapses cost more than the pair's length to the fourth") {
    //     2
    //    / \     Joining 3 and 4 lays the flap 0 1 3
    //   0---1
    //    \ / \    nearly upon the face 0 1 2.
    //     3---4
    const auto order_of_flap = [](double length, LinkCondition link, double distance_weight = 0) {
        const TriangleMesh flap = test::make({{0, 0, 0}, {1, 0, 0}, {0.5, 1, 0}, {0.5, -1, 0}, {1.5, -1, 0}},
                                             {{0, 1, 2}, {1, 0, 3}, {1, 3, 4}});
        Script script;
        script.offers[{3, 4}] = {0.5 * length, length, 0.1 * length};
        return squares_before(test::scaled(flap, length), script, 6, {link, -1, 0, -0.9}, Rung::fold,
                              distance_weight);
    };
    CHECK(order_of_flap(0.5, LinkCondition::by_size) == 0);
    CHECK(order_of_flap(1.1, LinkCondition::off) == 1);
    CHECK(order_of_flap(1.3, LinkCondition::by_size) == 2);
    CHECK(order_of_flap(0.5, LinkCondition::on) == 4);
    // The weight of distances, w, makes it wait for 2 w l^2, where that is more.
    CHECK(order_of_flap(0.5, LinkCondition::by_size, 3) == 1);
    CHECK(order_of_flap(0.5, LinkCondition::by_size, 5) == 2);
    CHECK(order_of_flap(1.1, LinkCondition::by_size, 0.1) == 1);
}

TEST_CASE("a strict link condition is kept on every rung") {
    const TriangleMesh mesh = test::both(test::quad(), test::moved(test::quad(), {5, 0, 0}));
    Script script;
    script.offers = {{{0, 2}, {0.5, 0.5, 0}}};
    Play<Script> play(mesh, script);
    play.locked[0] = play.locked[7] = 1;  // so that no part is deleted
    const LoopResult& result = play.run(2, {LinkCondition::strict, -0.5, 0});
    CHECK(result.stop == StopReason::no_legal_collapse);
    CHECK(taken(result, Rung::without_link) == 0);
    CHECK(taken(result, Rung::flip_any) == 1);
    CHECK(play.complex.face_count() == 4);
}

TEST_CASE("pairs shorter than the limit cost nothing because they are not collapsed, until flips are free") {
    Play<Script> play(hinge, turn_hinge(10));
    const LoopResult& result = play.run(1, {LinkCondition::off, 0, 100});
    CHECK(taken(result, Rung::flip_any) == 1);
    CHECK(refused(result, Refusal::zero_length) == 15);  // five pairs, looked at three times
    CHECK(result.stop == StopReason::reached_target);
}

TEST_CASE("small parts are deleted early, larger ones last, the largest never") {
    // Squares of sides 1, 2, 4 and 8, two faces each; no pair can be collapsed.
    TriangleMesh mesh;
    for (const double side : {4, 1, 8, 2})
        mesh = test::both(mesh, test::moved(test::scaled(test::quad(), side), {20 * side, 0, 0}));
    Play<Script> tiny(mesh, {});
    const LoopResult& one = tiny.run(6, {LinkCondition::on, 0, 0}, 1.5);
    CHECK(one.stop == StopReason::reached_target);
    CHECK(taken(one, Rung::tiny_components) == 1);
    CHECK(taken(one, Rung::any_component) == 0);
    CHECK(one.components_deleted == 1);
    CHECK_FALSE(tiny.complex.alive(2));
    Play<Script> all(mesh, {});
    const LoopResult& three = all.run(1, {LinkCondition::on, 0, 0}, 1.5);
    CHECK(three.stop == StopReason::no_legal_collapse);
    CHECK(taken(three, Rung::any_component) == 1);
    CHECK(three.components_deleted == 3);
    CHECK(all.complex.face_count() == 2);
    CHECK(all.complex.alive(4));
    const CollapseHistory history = all.recorder.take();
    REQUIRE(history.deleted_faces.size() == 6);
    CHECK(history.deleted_faces[0].face == 2);
    CHECK(history.deleted_faces[5].face == 1);
    Play<Script> some(mesh, {});
    CHECK(some.run(4, {LinkCondition::on, 0, 0}).components_deleted == 2);
    CHECK(some.complex.alive(0));
}

TEST_CASE("parts with locked vertices are not deleted, nor any part where UVs are kept") {
    const TriangleMesh mesh = test::both(test::quad(), test::moved(test::scaled(test::quad(), 3), {5, 0, 0}));
    Play<Script> play(mesh, {});
    play.locked[1] = 1;
    CHECK(play.run(2, {LinkCondition::off, 0, 0}, 2).components_deleted == 0);
    CHECK(play.result.stop == StopReason::no_legal_collapse);
    Play<Script> kept(mesh, {});
    kept.wedges = Wedges(kept.complex, {std::vector<float>(12, 0.5f), 1});
    CHECK(kept.run(2, {LinkCondition::off, 0, 0}).components_deleted == 0);
}

TEST_CASE("locked vertices hold the new point, two of them the pair") {
    Script script;
    script.offers = {{{0, 1}, {0.5, 0, 0}}, {{1, 2}, {1.5, 0, 0}}};
    Play<Script> play(test::grid(2), script);
    play.locked = {1, 1, 0, 0, 0, 0, 0, 0, 0};
    const LoopResult& result = play.run(1, {LinkCondition::off, 0, 0});
    CHECK(result.collapses == 1);
    CHECK(refused(result, Refusal::locked) > 0);
    CHECK(play.complex.position(1) == Vector3(1, 0, 0));
    const CollapseHistory history = play.recorder.take();
    CHECK(ends(history.collapses[0].first, history.collapses[0].second) == Ends(1, 2));
    CHECK(history.collapses[0].position == Vec3{1, 0, 0});
}

TEST_CASE("a virtual pair joins two parts into one") {
    const TriangleMesh mesh = test::both(test::quad(), test::moved(test::quad(), {1.5, 0, 0}));
    const std::vector<Ends> extra = {{1, 4}};
    Script script;
    script.offers = {{{1, 4}, {1.25, 0, 0}}, {{2, 3}, {0.5, 1, 0}}};
    Play<Script> play(mesh, script, extra);
    CHECK(play.run(3, {LinkCondition::off, 0, 0}).collapses == 2);
    CHECK(components(play.complex).size() == 1);
}

TEST_CASE("the last faces are not collapsed away") {
    Script script;
    for (Index u = 0; u < 4; ++u) {
        for (Index v = u + 1; v < 4; ++v) script.offers[{u, v}] = {0.5, 0.5, 0.25};
    }
    Play<Script> play(test::quad(), script);
    const LoopResult& result = play.run(0, {LinkCondition::off, 0, 0});
    CHECK(result.stop == StopReason::no_legal_collapse);
    CHECK(play.complex.face_count() > 0);
    CHECK(refused(result, Refusal::last_faces) > 0);
}

TEST_CASE("the end of a border waits for its distance to the next one") {
    // A ring between a triangle of side 4 and a hole 3 4 5 of side 1; squares beside it cost 0, 1 and 2.
    //
    //     5 is at (0, 0.5), 3 at (-0.5, -0.5), 4 at (0.5, -0.5); the outer corner nearest to 3 is sqrt(4.5)
    //     away.
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
    // The script's costs are 0 for the hole, then 1, 2 and 3.
    CHECK(order_of_hole(0) == 0);
    CHECK(order_of_hole(1.5 / 4.5) == 1);
    CHECK(order_of_hole(2.5 / 4.5) == 2);
}

TEST_CASE("where nothing may be collapsed, faces that lie on others go first, as many as needed") {
    // A square of two triangles; the first is there three times, the second as well the other way round.
    TriangleMesh mesh = test::quad();
    mesh.triangles = {{0, 1, 2}, {1, 2, 0}, {0, 2, 3}, {2, 0, 1}, {0, 3, 2}};
    for (const std::size_t target : {std::size_t{1}, std::size_t{4}}) {
        Play<Script> play(mesh, Script());
        const LoopResult& result = play.run(target, {LinkCondition::off, 0, 0});
        CHECK(play.complex.face_count() == std::max<std::size_t>(target, 3));
        CHECK(taken(result, Rung::double_faces) == 1);
        CHECK(play.complex.alive(0));  // the first of each stays
        CHECK(play.complex.alive(2));
        CHECK(play.complex.alive(4));
        CHECK(play.complex.alive(3) == (target == 4));
        play.pairs.for_each_pair(1, [&](Neighbour n) {
            if (n.vertex == 2) CHECK(play.pairs.face_count(n.pair) == (target == 4 ? 2 : 1));
        });
    }
}
