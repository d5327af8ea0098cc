#pragma once
/// \file
/// The collapses of an engine, of which some are undone afterwards.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "faqem/detail/base/vector.hpp"
#include "faqem/engine/mesh/collapse_mesh.hpp"
#include "faqem/export.hpp"

FAQEM_DETAIL_BEGIN

/// The collapses of pairs of one surface, in order. The surface without some of them is one that the engine could have
/// made: a step stays only if the faces around it were the same. Not thread-safe.
class UndoableSteps {
public:
    /// Adds a collapse. \param mesh  before the collapse
    void add(const engine::CollapseMesh& mesh, Index survivor, Index removed, const Vector3& to) {
        steps_.push_back({survivor, removed, to, faces_.size()});
        mesh.for_each_face_around(survivor, removed, [&](Index f, unsigned) { faces_.push_back(f); });
        is_undone_.push_back(0);
    }

    /// Number of steps that are not undone. O(steps)
    std::size_t count() const {
        return static_cast<std::size_t>(std::count(is_undone_.begin(), is_undone_.end(), std::uint8_t{0}));
    }

    /// Repeats the steps that are not undone. A step is undone as well if a face around it belongs to an undone one
    /// before it. O(faces + steps)
    /// \param face_slots  of the surface
    /// \param collapse    (survivor, removed, position)
    template <class Collapse>
    void replay(std::size_t face_slots, Collapse&& collapse) {
        last_.assign(face_slots, no_index);
        std::vector<std::uint8_t> is_older(face_slots, 0);
        for (Index i = 0; i < steps_.size(); ++i) {
            const std::size_t end = i + 1 < steps_.size() ? steps_[i + 1].first_face : faces_.size();
            const auto around = std::span(faces_).subspan(steps_[i].first_face, end - steps_[i].first_face);
            for (const Index f : around) is_undone_[i] |= is_older[f];
            if (is_undone_[i]) {
                for (const Index f : around) is_older[f] = 1;
            } else {
                for (const Index f : around) last_[f] = i;
                collapse(steps_[i].survivor, steps_[i].removed, steps_[i].to);
            }
        }
    }

    /// Undoes the last step around a face of the surface that the last replay() gave, from the next one on.
    /// \param face  its slot, or no_index
    /// \return false if there was none
    bool undo_last(Index face) {
        if (face == no_index || last_[face] == no_index) return false;
        is_undone_[last_[face]] = 1;
        return true;
    }

private:
    struct Step {
        Index survivor, removed;
        Vector3 to;
        std::size_t first_face;  // in faces_
    };

    std::vector<Step> steps_;
    std::vector<Index> faces_;  // around the pairs
    std::vector<std::uint8_t> is_undone_;
    std::vector<Index> last_;  // by face: the last step around it that was not undone, or no_index
};

FAQEM_DETAIL_END
