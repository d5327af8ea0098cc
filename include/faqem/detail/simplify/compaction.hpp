#pragma once
/// \file
/// Removes the unused slots of a simplified surface, for use by the next engine.

#include <span>
#include <vector>

#include "faqem/detail/base/vector.hpp"
#include "faqem/detail/rounds/round_steps.hpp"
#include "faqem/engine/mesh/collapse_mesh.hpp"
#include "faqem/export.hpp"

FAQEM_DETAIL_BEGIN

/// Tracks into which slot each vertex slot is merged by collapses, and which slots keep an original position.
class SlotTrace {
public:
    /// \param slots  number of vertex slots
    explicit SlotTrace(std::size_t slots);

    /// Called before `survivor` and `removed` are merged into `survivor` at position `to`.
    /// \param at_survivor, at_removed  their positions before the collapse
    void before_collapse(Index survivor, Index removed, const Vector3& at_survivor, const Vector3& at_removed,
                         const Vector3& to) {
        next_[removed] = survivor;
        if (to != at_survivor) source_slots_[survivor] = to == at_removed ? source_slots_[removed] : no_index;
    }

    /// One per slot: the slot whose initial position it has exactly, or no_index.
    const std::vector<Index>& source_slots() const { return source_slots_; }

    /// The slot that this slot has been merged into. O(log n) amortised, with path compression.
    Index root(Index slot);

private:
    std::vector<Index> next_, source_slots_;
};

/// Numbers the vertices of the remaining faces consecutively.
/// \param faces      slots of the remaining faces, ascending
/// \param triangles  one per remaining face, of vertex slots that were not removed
/// \param positions  one per vertex slot, engine units
/// \param trace      of the collapses
/// Complexity: O(n)
CompactedMesh compacted(std::vector<Index> faces, std::vector<Triangle> triangles,
                        std::span<const Vector3> positions, SlotTrace& trace);

/// Compacts the mesh of an engine.
/// \param trace  of the collapses of the engine
/// Complexity: O(n)
CompactedMesh compacted(const engine::CollapseMesh& mesh, SlotTrace& trace);

FAQEM_DETAIL_END

#ifdef FAQEM_HEADER_ONLY
#include "faqem/detail/simplify/compaction-inl.hpp"
#endif
