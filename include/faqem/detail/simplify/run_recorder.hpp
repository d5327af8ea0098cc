#pragma once
/// \file
/// The recorder of a run: slot trace, collapse history and cost curve.

#include <algorithm>
#include <limits>
#include <vector>

#include "faqem/detail/simplify/budget_by_cost.hpp"
#include "faqem/detail/simplify/compaction.hpp"
#include "faqem/detail/simplify/undoable_steps.hpp"
#include "faqem/engine/mesh/collapse_mesh.hpp"
#include "faqem/engine/quadric/placement.hpp"
#include "faqem/engine/recorder.hpp"
#include "faqem/export.hpp"

FAQEM_NAMESPACE_BEGIN
namespace detail {

/// Fills a SlotTrace, so that vertices that did not move keep their input position exactly, and optionally a
/// collapse history and a cost curve. It is one class, because an engine is compiled for each class of recorders.
class RunRecorder {
public:
    /// \param slots    number of vertex slots
    /// \param history  called first; may be null, otherwise it must outlive this object
    /// \param costs    receives the cost curve; may be null, otherwise it must outlive this object
    /// \param steps    receives the collapses; likewise
    RunRecorder(std::size_t slots, engine::HistoryRecorder* history,
                std::vector<CostCurve::Step>* costs = nullptr, UndoableSteps* steps = nullptr)
        : history_(history), costs_(costs), steps_(steps), trace_(slots) {}

    void before_collapse(const engine::CollapseMesh& mesh, Index survivor, Index removed,
                         const engine::Candidate& to) {
        if (history_) history_->before_collapse(mesh, survivor, removed, to);
        trace_.before_collapse(survivor, removed, mesh.position(survivor), mesh.position(removed), to.point);
        if (steps_) steps_->add(mesh, survivor, removed, to.point);
        if (costs_) {
            cost_ = std::max(cost_, to.cost);
            costs_->push_back({mesh.face_count(), cost_});
        }
    }
    void before_deletion(Index face) {
        if (history_) history_->before_deletion(face);
        // Deleting whole components is the last resort: it gets infinite cost.
        cost_ = std::numeric_limits<double>::infinity();
    }

    SlotTrace& trace() { return trace_; }

private:
    engine::HistoryRecorder* history_;
    std::vector<CostCurve::Step>* costs_;
    UndoableSteps* steps_;
    SlotTrace trace_;
    double cost_ = 0;
};

}  // namespace detail
FAQEM_NAMESPACE_END
