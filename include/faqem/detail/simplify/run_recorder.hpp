#pragma once
/// \file
/// The recorder of a run: slot trace, collapse history and cost curve.

#include <algorithm>
#include <cstddef>
#include <limits>
#include <span>
#include <vector>

#include "faqem/detail/rounds/round_steps.hpp"
#include "faqem/detail/simplify/budget_by_cost.hpp"
#include "faqem/detail/simplify/compaction.hpp"
#include "faqem/detail/simplify/undoable_steps.hpp"
#include "faqem/engine/mesh/collapse_mesh.hpp"
#include "faqem/engine/quadric/placement.hpp"
#include "faqem/engine/recorder.hpp"
#include "faqem/export.hpp"

FAQEM_DETAIL_BEGIN

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

/// Adds the collapses of all rounds to a history. Reserves memory for those that remain as well: growing the arrays
/// later would need twice as much. O(steps and their patches)
/// \param left    the surface after the steps
/// \param target  number of faces that later collapses leave
inline void record_steps(const RoundSteps& found, const CompactedMesh& left, std::size_t target,
                         engine::HistoryRecorder& history) {
    const std::size_t to_go = left.triangles.size() - target;
    const auto steps = static_cast<double>(std::max<std::size_t>(found.steps.size(), 1));
    const double share = 1.05 * (1 + 0.5 * static_cast<double>(to_go) / steps);
    history.reserve(static_cast<std::size_t>(share * static_cast<double>(found.steps.size())),
                    static_cast<std::size_t>(share * static_cast<double>(found.patch_faces.size())));
    for (std::size_t i = 0; i < found.steps.size(); ++i) {
        const auto& [survivor, gone, to] = found.steps[i];
        const std::size_t begin = found.patch_begin[i];
        const std::size_t end =
            i + 1 < found.steps.size() ? found.patch_begin[i + 1] : found.patch_faces.size();
        history.add_collapse(survivor, gone, to, std::span(found.patch_faces).subspan(begin, end - begin));
    }
    history.renumber(left.vertices, left.faces);
}

FAQEM_DETAIL_END
