#pragma once
/// \file
/// The rules that the starvation ladder relaxes, one after the other, where no collapse is legal any more.

#include <utility>

#include "faqem/export.hpp"
#include "faqem/engine/constraints/legality.hpp"
#include "faqem/report.hpp"

FAQEM_NAMESPACE_BEGIN
namespace engine {

/// Whether the curves between groups are to be kept.
enum class Groups { free, kept };

/// Relaxes what stands in the way of the rung. O(1)
/// \return false where the rules were as lax before, or the rung is none of rules
inline bool relax(Rules& rules, Rung rung, Groups groups) {
    const auto allow_turn = [&](double limit) {
        if (!(rules.least_turn > limit)) return false;
        rules.least_turn = limit;
        return true;
    };
    switch (rung) {
        case Rung::without_link:
            if (rules.link != LinkCondition::on && rules.link != LinkCondition::by_size) return false;
            rules.link = LinkCondition::off;
            return true;
        case Rung::fold:
            return std::exchange(rules.least_fold, -1) > -1;
        case Rung::flip_zero:
            return allow_turn(0);
        case Rung::flip_half:
            return groups == Groups::free && allow_turn(-0.5);
        case Rung::flip_any:
            // Faces that turn over would cover another group's ground.
            if (groups == Groups::kept) return false;
            rules.least_length = 0;
            return allow_turn(-1);
        case Rung::reseed:
        case Rung::double_faces:
        case Rung::tiny_components:
        case Rung::any_component:
            break;
    }
    return false;
}

}  // namespace engine
FAQEM_NAMESPACE_END
