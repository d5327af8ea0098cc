#pragma once
/// \file
/// Recorders that a run uses in addition to the history recorder.

#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

#include "faqem/detail/simplify/budget_by_cost.hpp"
#include "faqem/detail/simplify/compaction.hpp"
#include "faqem/engine/mesh/collapse_mesh.hpp"
#include "faqem/engine/quadric/placement.hpp"
#include "faqem/export.hpp"

FAQEM_NAMESPACE_BEGIN
namespace detail {

/// Forwards to another recorder and fills a SlotTrace, so that vertices that did not move keep their input
/// position exactly.
template <class Recorder>
class TracingRecorder {
public:
    /// \param inner  called first; must outlive this object
    /// \param slots  number of vertex slots
    TracingRecorder(Recorder& inner, std::size_t slots) : inner_(inner), trace_(slots) {}

    void before_collapse(const engine::CollapseMesh& mesh, Index survivor, Index removed,
                         const engine::Candidate& to) {
        inner_.before_collapse(mesh, survivor, removed, to);
        trace_.before_collapse(survivor, removed, mesh.position(survivor), mesh.position(removed), to.point);
    }
    void before_deletion(Index face) { inner_.before_deletion(face); }

    SlotTrace& trace() { return trace_; }

private:
    Recorder& inner_;
    SlotTrace trace_;
};

/// Records the cost curve of a run.
class CostRecorder {
public:
    void before_collapse(const engine::CollapseMesh& mesh, Index, Index, const engine::Candidate& to) {
        cost_ = std::max(cost_, to.cost);
        steps_.push_back({mesh.face_count(), cost_});
    }
    // Deleting whole components is the last resort: it gets infinite cost.
    void before_deletion(Index) { cost_ = std::numeric_limits<double>::infinity(); }
    std::vector<CostCurve::Step> take() { return std::move(steps_); }

private:
    std::vector<CostCurve::Step> steps_;
    double cost_ = 0;
};

}  // namespace detail
FAQEM_NAMESPACE_END
