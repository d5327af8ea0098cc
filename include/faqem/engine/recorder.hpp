#pragma once
/// \file
/// Recorders see every collapse before it happens. NoRecorder compiles to nothing.

#include <concepts>
#include <numeric>
#include <utility>
#include <vector>

#include "faqem/engine/complex.hpp"
#include "faqem/engine/placement.hpp"
#include "faqem/history.hpp"

namespace faqem::engine {

template <class R>
concept CollapseRecorder = requires(R recorder, const Complex& complex, Index survivor, Index gone,
                                    const Candidate& to, Index face) {
    // Both are about to become `survivor` at to.point; the complex is still as before.
    {recorder.collapsing(complex, survivor, gone, to)};
    // The face goes with its component.
    {recorder.deleting(face)};
};

/// Records nothing, at no cost.
struct NoRecorder {
    void collapsing(const Complex&, Index, Index, const Candidate&) {}
    void deleting(Index) {}
};

/// Records the collapse history, in slots and engine units.
class HistoryRecorder {
public:
    /// \param complex  before the first collapse
    explicit HistoryRecorder(const Complex& complex) {
        history_.patch_begin.push_back(0);
        version_.resize(complex.vertex_slots());
        std::iota(version_.begin(), version_.end(), Index{0});
    }

    void collapsing(const Complex& complex, Index survivor, Index gone, const Candidate& to) {
        const auto fresh = static_cast<Index>(version_.size() + history_.collapses.size());
        history_.collapses.push_back({version_[survivor], version_[gone], to_array(to.point)});
        complex.for_each_face_around(survivor, gone,
                                     [&](Index f, unsigned) { history_.patch_faces.push_back(f); });
        history_.patch_begin.push_back(history_.patch_faces.size());
        version_[survivor] = fresh;
    }

    void deleting(Index face) { history_.deleted_faces.push_back({history_.collapses.size(), face}); }

    /// The version that a vertex slot is now.
    Index version(Index slot) const { return version_[slot]; }

    /// Gives away the collapses, their patches and the deleted faces; the rest is the caller's to fill.
    CollapseHistory take() { return std::move(history_); }

private:
    CollapseHistory history_;
    std::vector<Index> version_;  // of each vertex slot
};

static_assert(CollapseRecorder<NoRecorder> && CollapseRecorder<HistoryRecorder>);

}  // namespace faqem::engine
