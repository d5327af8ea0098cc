#pragma once
/// \file
/// Relaxation of the legality rules by the starvation ladder when no legal collapse is left.

#include <utility>

#include "faqem/engine/constraints/legality.hpp"
#include "faqem/export.hpp"
#include "faqem/report.hpp"

FAQEM_ENGINE_BEGIN

/// Relaxes the rule that belongs to a rung of the ladder. O(1)
/// \param rules   modified
/// \param rung    any rung
/// \return false if the rules do not change: they are already relaxed this far, or the rung has no rule
inline bool relax_rule(Rules& rules, Rung rung) {
    const auto lower_min_normal_cosine = [&](double limit) {
        if (!(rules.min_normal_cosine > limit)) return false;
        rules.min_normal_cosine = limit;
        return true;
    };
    switch (rung) {
        case Rung::group_boundaries:
            if (rules.groups != GroupBoundaries::preferred) return false;
            rules.groups = GroupBoundaries::free;
            return true;
        case Rung::without_link:
            if (rules.link != LinkCondition::on && rules.link != LinkCondition::by_size) return false;
            rules.link = LinkCondition::off;
            return true;
        case Rung::fold:
            return std::exchange(rules.min_fold_cosine, -1) > -1;
        case Rung::flip_zero:
            return lower_min_normal_cosine(0);
        case Rung::flip_half:
            // Flipped faces could overlap faces of another group.
            return rules.groups != GroupBoundaries::preserved && lower_min_normal_cosine(-0.5);
        case Rung::flip_any:
            if (rules.groups == GroupBoundaries::preserved) return false;
            rules.min_pair_length = 0;
            return lower_min_normal_cosine(-1);
        case Rung::reseed:
        case Rung::duplicate_faces:
        case Rung::tiny_components:
        case Rung::any_component:
            break;
    }
    return false;
}

FAQEM_ENGINE_END
