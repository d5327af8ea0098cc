// Tests of the starvation ladder: the rules it lifts and the faces it deletes.
#include "faqem/engine/engine.hpp"

#include <algorithm>

#include "support/catch.hpp"
#include "support/engine_script.hpp"
#include "support/meshes.hpp"

using namespace faqem;
using namespace faqem::engine;
using namespace faqem::test;

TEST_CASE("ladder: flips to a cosine of -1/2 are allowed first, then all flips, and each rung is counted") {
    Play<Script> gentle(hinge(), turn_hinge(80));
    CHECK(gentle.run(1, {LinkCondition::off, 0, 0}).rungs == decltype(LoopResult::rungs){});
    Play<Script> half(hinge(), turn_hinge(100));
    const LoopResult& first = half.run(1, {LinkCondition::off, 0, 0});
    CHECK(first.stop == StopReason::reached_target);
    CHECK(taken(first, Rung::reseed) == 1);
    CHECK(taken(first, Rung::without_link) == 0);
    CHECK(taken(first, Rung::flip_half) == 1);
    CHECK(taken(first, Rung::flip_any) == 0);
    CHECK(refused(first, Refusal::flip) == 2);
    Play<Script> any(hinge(), turn_hinge(150));
    const LoopResult& second = any.run(1, {LinkCondition::off, 0, 0});
    CHECK(second.stop == StopReason::reached_target);
    CHECK(taken(second, Rung::flip_half) == 1);
    CHECK(taken(second, Rung::flip_any) == 1);
    CHECK(refused(second, Refusal::flip) == 3);
}

TEST_CASE("ladder: the link condition is lifted before flips are allowed") {
    // The diagonal of a square is collapsed to its midpoint. The mesh has two more faces, so that some are
    // left.
    TriangleMesh mesh = test::both(test::quad(), test::moved(test::quad(), {5, 0, 0}));
    Play<Script> play(mesh, Script({{{0, 2}, {0.5, 0.5, 0}}}));
    const LoopResult& result = play.run(2, {LinkCondition::on, 0, 0});
    CHECK(result.stop == StopReason::reached_target);
    CHECK(taken(result, Rung::reseed) == 1);
    CHECK(taken(result, Rung::without_link) == 1);
    CHECK(taken(result, Rung::flip_half) == 0);
    CHECK(refused(result, Refusal::link) == 2);
}

namespace {

// Adds four squares to a mesh with vertices 0 to 4, whose collapses cost 1, 2, 3 and 4, while that of the
// mesh costs 0. Returns the number of squares that are collapsed before the pair of the mesh.
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

TEST_CASE("ladder: by_size lifts the link condition at a cost of the fourth power of the pair length") {
    // Two tetrahedra at the triangle 0 1 2: collapsing two of its vertices would leave duplicate faces.
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

TEST_CASE("ladder: by_size allows a fold at a cost of the fourth power of the pair length") {
    //     2
    //    / \     Collapsing (3, 4) moves the face 0 1 3
    //   0---1
    //    \ / \    nearly onto the face 0 1 2.
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
    // The distance weight w delays it to a cost of 2 w l^2, if that is more.
    CHECK(order_of_flap(0.5, LinkCondition::by_size, 3) == 1);
    CHECK(order_of_flap(0.5, LinkCondition::by_size, 5) == 2);
    CHECK(order_of_flap(1.1, LinkCondition::by_size, 0.1) == 1);
}

TEST_CASE("ladder: a strict link condition is never lifted") {
    const TriangleMesh mesh = test::both(test::quad(), test::moved(test::quad(), {5, 0, 0}));
    Play<Script> play(mesh, Script({{{0, 2}, {0.5, 0.5, 0}}}));
    play.locked[0] = play.locked[7] = 1;  // so that no component is deleted
    const LoopResult& result = play.run(2, {LinkCondition::strict, -0.5, 0});
    CHECK(result.stop == StopReason::no_legal_collapse);
    CHECK(taken(result, Rung::without_link) == 0);
    CHECK(taken(result, Rung::flip_any) == 1);
    CHECK(play.collapse_mesh.face_count() == 4);
}

TEST_CASE("ladder: pairs below the minimum length are not collapsed until all flips are allowed") {
    // The hinge with its apexes 1e-9 away from each other.
    const TriangleMesh narrow =
        test::make({{0, 0, 0}, {2, 0, 0}, {1, 1, 0}, {1 + 1e-9, 1, 0}}, {{0, 1, 2}, {1, 3, 2}});
    Play<Script> play(narrow, Script({{{2, 3}, {1, 1, 0}}}));
    const LoopResult& result = play.run(1, {LinkCondition::off, 0, 1e-8});
    CHECK(taken(result, Rung::flip_any) == 1);
    CHECK(refused(result, Refusal::zero_length) == 3);  // one pair, evaluated three times
    CHECK(result.stop == StopReason::reached_target);
}

TEST_CASE("ladder: pairs below the minimum length are collapsed if all faces around them are as small") {
    Play<Script> play(hinge(), turn_hinge(10));
    const LoopResult& result = play.run(1, {LinkCondition::off, 0, 100});
    CHECK(result.rungs == decltype(LoopResult::rungs){});
    CHECK(refused(result, Refusal::zero_length) == 0);
}

TEST_CASE("ladder: tiny components are deleted early, larger ones last and the largest never") {
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
    CHECK_FALSE(tiny.collapse_mesh.is_alive(2));
    Play<Script> all(mesh, {});
    const LoopResult& three = all.run(1, {LinkCondition::on, 0, 0}, 1.5);
    CHECK(three.stop == StopReason::no_legal_collapse);
    CHECK(taken(three, Rung::any_component) == 1);
    CHECK(three.components_deleted == 3);
    CHECK(all.collapse_mesh.face_count() == 2);
    CHECK(all.collapse_mesh.is_alive(4));
    const CollapseHistory history = all.recorder.take();
    REQUIRE(history.deleted_faces.size() == 6);
    CHECK(history.deleted_faces[0].face == 2);
    CHECK(history.deleted_faces[5].face == 1);
    Play<Script> some(mesh, {});
    CHECK(some.run(4, {LinkCondition::on, 0, 0}).components_deleted == 2);
    CHECK(some.collapse_mesh.is_alive(0));
}

TEST_CASE("ladder: a component with more than 2% of the area is not tiny") {
    const TriangleMesh mesh = test::both(test::quad(), test::moved(test::scaled(test::quad(), 3), {5, 0, 0}));
    Play<Script> play(mesh, {});
    const LoopResult& result = play.run(2, {LinkCondition::off, 0, 0}, 2);
    CHECK(taken(result, Rung::tiny_components) == 0);
    CHECK(taken(result, Rung::any_component) == 1);
    CHECK(result.components_deleted == 1);
}

TEST_CASE("ladder: components with locked vertices are not deleted, and none if attributes are preserved") {
    const TriangleMesh mesh = test::both(test::quad(), test::moved(test::scaled(test::quad(), 3), {5, 0, 0}));
    Play<Script> play(mesh, {});
    play.locked[1] = 1;
    CHECK(play.run(2, {LinkCondition::off, 0, 0}, 2).components_deleted == 0);
    CHECK(play.result.stop == StopReason::no_legal_collapse);
    Play<Script> kept(mesh, {});
    kept.wedges = Wedges(kept.collapse_mesh, {std::vector<float>(12, 0.5f), 1});
    CHECK(kept.run(2, {LinkCondition::off, 0, 0}).components_deleted == 0);
}

TEST_CASE("ladder: duplicate faces are deleted before other rungs, as many as needed") {
    // A square of two triangles. The first occurs three times, the second also with the opposite winding.
    TriangleMesh mesh = test::quad();
    mesh.triangles = {{0, 1, 2}, {1, 2, 0}, {0, 2, 3}, {2, 0, 1}, {0, 3, 2}};
    for (const std::size_t target : {std::size_t{1}, std::size_t{4}}) {
        Play<Script> play(mesh, Script());
        const LoopResult& result = play.run(target, {LinkCondition::off, 0, 0});
        CHECK(play.collapse_mesh.face_count() == std::max<std::size_t>(target, 3));
        CHECK(taken(result, Rung::duplicate_faces) == 1);
        CHECK(play.collapse_mesh.is_alive(0));  // the first of each is kept
        CHECK(play.collapse_mesh.is_alive(2));
        CHECK(play.collapse_mesh.is_alive(4));
        CHECK(play.collapse_mesh.is_alive(3) == (target == 4));
        play.pairs.for_each_pair(1, [&](Neighbour n) {
            if (n.vertex == 2) CHECK(play.pairs.face_count(n.pair) == (target == 4 ? 2 : 1));
        });
    }
}

TEST_CASE("ladder: components of zero area are deleted first regardless of their length") {
    const TriangleMesh line = test::make({{0, 0, 1}, {100, 0, 1}, {50, 0, 1}}, {{0, 1, 2}});
    Play<Script> play(test::both(line, test::quad()), Script());
    const LoopResult& result = play.run(2, {LinkCondition::off, 0, 0});
    CHECK(result.stop == StopReason::reached_target);
    CHECK(result.components_deleted == 1);
    CHECK(taken(result, Rung::tiny_components) == 1);
    CHECK_FALSE(play.collapse_mesh.is_alive(0));
}
