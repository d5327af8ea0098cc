#pragma once
/// \file
/// Rules that are lifted for single pairs, because all other collapses cost more.

#include <algorithm>
#include <cstdint>
#include <vector>

#include "faqem/engine/constraints/legality.hpp"
#include "faqem/export.hpp"
#include "faqem/report.hpp"

FAQEM_ENGINE_BEGIN

/// Records for each pair whether the link condition and the fold rule are lifted.
class RuleExceptions {
public:
    /// \param pairs  number of pairs
    explicit RuleExceptions(std::size_t pairs) : lifted_(pairs, 0) {}

    /// True if a collapse that was refused for this reason may be done at a higher cost.
    static bool is_liftable(const Rules& rules, Refusal refusal) {
        if (rules.link == LinkCondition::by_size) return refusal == Refusal::link || refusal == Refusal::fold;
        return refusal == Refusal::fold && rules.link == LinkCondition::off;
    }

    /// Lifts the rule that refused a pair.
    /// \param refusal          is_liftable()
    /// \param squared_length   of the pair
    /// \param distance_weight  cost of a squared distance
    /// \return the cost of breaking the rule. The feature that the rule preserves is about as large as the
    ///     pair: removing it moves the surface by the length l over an area of l^2, which costs l^4. The area
    ///     of a fold is at least twice `distance_weight`, because a fold is visible beyond that area.
    double lift(Index pair, Refusal refusal, double squared_length, double distance_weight) {
        lifted_[pair] |= refusal == Refusal::link ? link_bit : fold_bit;
        double area = squared_length;
        if (refusal == Refusal::fold) area = std::max(area, fold_factor * distance_weight);
        return squared_length * area;
    }

    void clear(Index pair) { lifted_[pair] = 0; }
    bool any(Index pair) const { return lifted_[pair] != 0; }
    bool lifts_link(Index pair) const { return (lifted_[pair] & link_bit) != 0; }
    bool lifts_fold(Index pair) const { return (lifted_[pair] & fold_bit) != 0; }

    /// The rules that hold for a pair.
    Rules rules_for(Index pair, Rules rules) const {
        if (lifts_link(pair)) rules.link = LinkCondition::off;
        if (lifts_fold(pair)) rules.min_fold_cosine = -1;
        return rules;
    }

private:
    static constexpr std::uint8_t link_bit = 1, fold_bit = 2;
    static constexpr double fold_factor = 2;

    std::vector<std::uint8_t> lifted_;
};

FAQEM_ENGINE_END
