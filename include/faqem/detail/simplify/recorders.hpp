#pragma once
/// \file
/// What a run learns from its collapses besides the history.

#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

#include "faqem/export.hpp"
#include "faqem/detail/simplify/budget_by_cost.hpp"
#include "faqem/engine/mesh/triangle_soup.hpp"
#include "faqem/engine/quadric/placement.hpp"
#include "faqem/detail/simplify/compaction.hpp"

FAQEM_NAMESPACE_BEGIN
namespace detail {

/// Passes everything on, and remembers where slots went and whose place they still have, so that what did not
/// move comes out to the last bit.
template <class Recorder>
class TracingRecorder {
public:
    /// \param inner  borrowed
    TracingRecorder(Recorder& inner, std::size_t slots) : inner_(inner), trace_(slots) {}

    void collapsing(const engine::Complex& complex, Index survivor, Index gone, const engine::Candidate& to) {
        inner_.collapsing(complex, survivor, gone, to);
        trace_.collapsing(survivor, gone, complex.position(survivor), complex.position(gone), to.point);
    }
    void deleting(Index face) { inner_.deleting(face); }

    SlotTrace& trace() { return trace_; }

private:
    Recorder& inner_;
    SlotTrace trace_;
};

/// Records what every collapse cost.
class CostRecorder {
public:
    void collapsing(const engine::Complex& complex, Index, Index, const engine::Candidate& to) {
        cost_ = std::max(cost_, to.cost);
        steps_.push_back({complex.face_count(), cost_});
    }
    // What takes whole components is the last resort.
    void deleting(Index) { cost_ = std::numeric_limits<double>::infinity(); }
    std::vector<CostCurve::Step> take() { return std::move(steps_); }

private:
    std::vector<CostCurve::Step> steps_;
    double cost_ = 0;
};

}  // namespace detail
FAQEM_NAMESPACE_END
