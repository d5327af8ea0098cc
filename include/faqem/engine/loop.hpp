#pragma once
/// \file
/// What goes into the collapse loop, and what it tells of its work.

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>

#include "faqem/engine/constraints/legality.hpp"
#include "faqem/engine/mesh/vector.hpp"
#include "faqem/export.hpp"
#include "faqem/progress.hpp"
#include "faqem/report.hpp"

FAQEM_NAMESPACE_BEGIN
namespace engine {

/// What the loop does where no collapse is legal above the target.
enum class Ladder {
    on,   ///< looks at all pairs again, then relaxes one rule after the other
    off,  ///< stops
};

/// What the loop needs besides the complex, the metric and the recorder.
struct LoopOptions {
    std::size_t target_faces = 4;
    Rules rules = {};
    Ladder ladder = Ladder::on;
    /// Vertices from here on are there for their faces with others; what else lies around them is not known.
    /// They must be locked, and so must their neighbours.
    Index first_context_vertex = no_index;
    /// What the square of a distance costs that the metric does not see: from a border that ends or begins to
    /// the next one, and twice that of a pair whose collapse folds the surface. 0: nothing.
    double distance_weight = 0;
    /// Components with a smaller box diagonal may be deleted early by the ladder. Engine units.
    double tiny_component_diagonal = 0;
    /// Called every few thousand operations with the share of faces removed; may be empty. Where it throws,
    /// or cancels, the complex stays whole.
    std::function<Continue(double)> progress = {};
};

/// What the loop did.
struct LoopResult {
    StopReason stop = StopReason::reached_target;
    std::uint64_t collapses = 0;
    std::array<std::uint64_t, refusal_kinds> refusals = {};
    std::array<std::uint64_t, rung_kinds> rungs = {};
    std::uint64_t components_deleted = 0;
};

}  // namespace engine
FAQEM_NAMESPACE_END
