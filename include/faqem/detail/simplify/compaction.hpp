#pragma once
/// \file
/// What collapses have left of a surface in slots, and how the next round begins with it.

#include <span>
#include <vector>

#include "faqem/engine/mesh/collapse_mesh.hpp"
#include "faqem/engine/mesh/vector.hpp"
#include "faqem/export.hpp"

FAQEM_NAMESPACE_BEGIN
namespace detail {

/// What is left after some steps.
struct CompactedMesh {
    std::vector<Index> vertices, faces;  ///< slots that are left, in order
    std::vector<Index>
        vertex_map;  ///< of each vertex slot: which of `vertices` it has gone into, or no_index
    std::vector<Index> source_slots;  ///< of each of `vertices`: the slot whose place it has, or no_index
    std::vector<engine::Vector3> positions;
    std::vector<Triangle> triangles;
};

/// Follows vertex slots through collapses.
class SlotTrace {
public:
    explicit SlotTrace(std::size_t slots);

    /// Both are about to become `survivor` at `to`.
    /// \param at_survivor, at_removed  where they are
    void before_collapse(Index survivor, Index removed, const engine::Vector3& at_survivor,
                         const engine::Vector3& at_removed, const engine::Vector3& to) {
        next_[removed] = survivor;
        if (to != at_survivor) source_slots_[survivor] = to == at_removed ? source_slots_[removed] : no_index;
    }

    /// Of each slot: the slot whose place it has to the last bit, or no_index.
    const std::vector<Index>& source_slots() const { return source_slots_; }

    /// The slot that this one has gone into. O(log n) amortised; shortens the way for the next one.
    Index root(Index slot);

private:
    std::vector<Index> next_, source_slots_;
};

/// Numbers the vertices of what is left.
/// \param faces      slots that are left, in order
/// \param triangles  of vertex slots that are left, one per face
/// \param positions  of all vertex slots
/// \throws what the poll throws.
/// O(n)
CompactedMesh compacted(std::vector<Index> faces, std::vector<Triangle> triangles,
                        std::span<const engine::Vector3> positions, SlotTrace& trace,
                        engine::CancellationCheck check_cancelled = {});

/// What an engine has left.
/// \param trace  of its collapses.
/// \throws what the poll throws.
/// O(n)
CompactedMesh compacted(const engine::CollapseMesh& mesh, SlotTrace& trace,
                        engine::CancellationCheck check_cancelled = {});

}  // namespace detail
FAQEM_NAMESPACE_END

#ifdef FAQEM_HEADER_ONLY
#include "faqem/detail/simplify/compaction-inl.hpp"
#endif
