#pragma once
/// \file
/// The rules that the starvation ladder relaxes, one after the other, where no collapse is legal any more.

#include <utility>

#include "faqem/engine/constraints/legality.hpp"
#include "faqem/export.hpp"
#include "faqem/report.hpp"

FAQEM_NAMESPACE_BEGIN
namespace engine {

/// Whether the curves between groups are to be kept.
enum class CurvePolicy { free, kept };

/// Relaxes what stands in the way of the rung. O(1)
/// \return false where the rules were as lax before, or the rung is none of rules
inline bool relax_rule(Rules& rules, Rung rung, CurvePolicy groups) {
    const auto lower_min_normal_cosine = [&](double limit) {
        if (!(rules.min_normal_cosine > limit)) return false;
        rules.min_normal_cosine = limit;
        return true;
    };
    switch (rung) {
        case Rung::without_link:
            if (rules.link != LinkCondition::on && rules.link != LinkCondition::by_size) return false;
            rules.link = LinkCondition::off;
            return true;
        case Rung::fold:
            return std::exchange(rules.min_fold_cosine, -1) > -1;
        case Rung::flip_zero:
            return lower_min_normal_cosine(0);
        case Rung::flip_half:
            return groups == CurvePolicy::free && lower_min_normal_cosine(-0.5);
        case Rung::flip_any:
            // Faces that turn over would cover another group's ground.
            if (groups == CurvePolicy::kept) return false;
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

}  // namespace engine
FAQEM_NAMESPACE_END
