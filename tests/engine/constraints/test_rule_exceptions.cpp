#include "faqem/engine/constraints/rule_exceptions.hpp"

#include "support/catch.hpp"

using namespace faqem;
using namespace faqem::engine;

TEST_CASE("rule exceptions: a rule is lifted for one pair only, until it is cleared") {
    RuleExceptions exceptions(3);
    const Rules rules{LinkCondition::by_size, 0.2, 0, -0.5};
    exceptions.lift(1, Refusal::link, 4, 0);
    CHECK(!exceptions.any(0));
    CHECK(exceptions.lifts_link(1));
    CHECK(!exceptions.lifts_fold(1));
    CHECK(exceptions.rules_for(1, rules).link == LinkCondition::off);
    CHECK(exceptions.rules_for(1, rules).min_fold_cosine == -0.5);
    CHECK(exceptions.rules_for(0, rules).link == LinkCondition::by_size);
    exceptions.lift(1, Refusal::fold, 4, 0);
    CHECK(exceptions.rules_for(1, rules).min_fold_cosine == -1);
    exceptions.clear(1);
    CHECK(!exceptions.any(1));
}

TEST_CASE("rule exceptions: lifting costs the length^4, for folds at least two distance weights") {
    RuleExceptions exceptions(1);
    CHECK(exceptions.lift(0, Refusal::link, 9, 100) == 81);
    CHECK(exceptions.lift(0, Refusal::fold, 9, 1) == 81);
    CHECK(exceptions.lift(0, Refusal::fold, 9, 100) == 1800);
}

TEST_CASE("rule exceptions: only rules that depend on the size of a feature are liftable") {
    Rules rules{LinkCondition::by_size, 0, 0, -0.5};
    CHECK(RuleExceptions::is_liftable(rules, Refusal::link));
    CHECK(RuleExceptions::is_liftable(rules, Refusal::fold));
    CHECK(!RuleExceptions::is_liftable(rules, Refusal::flip));
    rules.link = LinkCondition::off;
    CHECK(RuleExceptions::is_liftable(rules, Refusal::fold));
    rules.link = LinkCondition::on;
    CHECK(!RuleExceptions::is_liftable(rules, Refusal::fold));
    CHECK(!RuleExceptions::is_liftable(rules, Refusal::link));
}
