#include "faqem/engine/ladder.hpp"

#include <catch2/catch.hpp>

using namespace faqem;
using namespace faqem::engine;

TEST_CASE("each rung relaxes its own rule, once") {
    Rules rules{.link = LinkCondition::on, .least_turn = 0.2, .least_length = 1e-8, .least_fold = 0.5};
    CHECK(relax(rules, Rung::without_link, Groups::free));
    CHECK(rules.link == LinkCondition::off);
    CHECK(relax(rules, Rung::fold, Groups::free));
    CHECK(rules.least_fold == -1);
    CHECK(relax(rules, Rung::flip_zero, Groups::free));
    CHECK(rules.least_turn == 0);
    CHECK(relax(rules, Rung::flip_half, Groups::free));
    CHECK(rules.least_turn == -0.5);
    CHECK(rules.least_length == 1e-8);
    CHECK(relax(rules, Rung::flip_any, Groups::free));
    CHECK(rules.least_turn == -1);
    CHECK(rules.least_length == 0);
    for (const Rung rung : {Rung::without_link, Rung::fold, Rung::flip_zero, Rung::flip_half, Rung::flip_any})
        CHECK(!relax(rules, rung, Groups::free));
}

TEST_CASE("where the link condition holds by size, the rung lifts it for good") {
    Rules rules{.link = LinkCondition::by_size};
    CHECK(relax(rules, Rung::without_link, Groups::free));
    CHECK(rules.link == LinkCondition::off);
}

TEST_CASE("faces do not turn over where groups are kept") {
    Rules rules{.least_turn = 0.2, .least_length = 1e-8};
    CHECK(!relax(rules, Rung::flip_half, Groups::kept));
    CHECK(!relax(rules, Rung::flip_any, Groups::kept));
    CHECK(rules.least_turn == 0.2);
    CHECK(rules.least_length == 1e-8);
    CHECK(relax(rules, Rung::flip_zero, Groups::kept));
}

TEST_CASE("rungs that are none of rules relax none") {
    Rules rules{.link = LinkCondition::on, .least_turn = 0.2, .least_fold = 0.5};
    for (const Rung rung : {Rung::reseed, Rung::double_faces, Rung::tiny_components, Rung::any_component})
        CHECK(!relax(rules, rung, Groups::free));
    CHECK(rules.least_turn == 0.2);
}
