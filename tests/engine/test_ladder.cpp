#include "faqem/engine/ladder.hpp"

#include "support/catch.hpp"

using namespace faqem;
using namespace faqem::engine;

TEST_CASE("relax_rule: each rung relaxes one rule, once") {
    Rules rules{.link = LinkCondition::on,
                .min_normal_cosine = 0.2,
                .min_pair_length = 1e-8,
                .min_fold_cosine = 0.5,
                .groups = GroupBoundaries::preferred};
    CHECK(relax_rule(rules, Rung::group_boundaries));
    CHECK(rules.groups == GroupBoundaries::free);
    CHECK(relax_rule(rules, Rung::without_link));
    CHECK(rules.link == LinkCondition::off);
    CHECK(relax_rule(rules, Rung::fold));
    CHECK(rules.min_fold_cosine == -1);
    CHECK(relax_rule(rules, Rung::flip_zero));
    CHECK(rules.min_normal_cosine == 0);
    CHECK(relax_rule(rules, Rung::flip_half));
    CHECK(rules.min_normal_cosine == -0.5);
    CHECK(rules.min_pair_length == 1e-8);
    CHECK(relax_rule(rules, Rung::flip_any));
    CHECK(rules.min_normal_cosine == -1);
    CHECK(rules.min_pair_length == 0);
    for (const Rung rung : {Rung::group_boundaries, Rung::without_link, Rung::fold, Rung::flip_zero,
                            Rung::flip_half, Rung::flip_any})
        CHECK(!relax_rule(rules, rung));
}

TEST_CASE("relax_rule: without_link also lifts a link condition by_size") {
    Rules rules{.link = LinkCondition::by_size};
    CHECK(relax_rule(rules, Rung::without_link));
    CHECK(rules.link == LinkCondition::off);
}

TEST_CASE("relax_rule: flips above 90 degrees stay forbidden if groups are preserved") {
    Rules rules{.min_normal_cosine = 0.2, .min_pair_length = 1e-8};
    CHECK(!relax_rule(rules, Rung::group_boundaries));
    CHECK(!relax_rule(rules, Rung::flip_half));
    CHECK(!relax_rule(rules, Rung::flip_any));
    CHECK(rules.min_normal_cosine == 0.2);
    CHECK(rules.min_pair_length == 1e-8);
    CHECK(relax_rule(rules, Rung::flip_zero));
}

TEST_CASE("relax_rule: rungs without a rule change nothing") {
    Rules rules{.link = LinkCondition::on, .min_normal_cosine = 0.2, .min_fold_cosine = 0.5};
    for (const Rung rung : {Rung::reseed, Rung::duplicate_faces, Rung::tiny_components, Rung::any_component})
        CHECK(!relax_rule(rules, rung));
    CHECK(rules.min_normal_cosine == 0.2);
}
