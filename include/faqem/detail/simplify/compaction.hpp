#pragma once
/// \file
/// What collapses have left of a surface in slots, and how the next round begins with it.

#include <span>
#include <vector>

#include "faqem/export.hpp"
#include "faqem/engine/mesh/triangle_soup.hpp"
#include "faqem/engine/mesh/vector.hpp"

FAQEM_NAMESPACE_BEGIN
namespace detail {

/// What is left after some steps.
struct Reduced {
    std::vector<Index> vertices, faces;  ///< slots that are left, in order
    std::vector<Index> into;    ///< of each vertex slot: which of `vertices` it has gone into, or no_index
    std::vector<Index> places;  ///< of each of `vertices`: the slot whose place it has, or no_index
    std::vector<engine::Vector3> positions;
    std::vector<Triangle> triangles;
};

/// Follows vertex slots through collapses.
class SlotTrace {
public:
    explicit SlotTrace(std::size_t slots);

    /// Both are about to become `survivor` at `to`.
    /// \param at_survivor, at_gone  where they are
    void collapsing(Index survivor, Index gone, const engine::Vector3& at_survivor,
                    const engine::Vector3& at_gone, const engine::Vector3& to) {
        next_[gone] = survivor;
        if (to != at_survivor) places_[survivor] = to == at_gone ? places_[gone] : no_index;
    }

    /// Of each slot: the slot whose place it has to the last bit, or no_index.
    const std::vector<Index>& places() const { return places_; }

    /// The slot that this one has gone into. O(log n) amortised; shortens the way for the next one.
    Index root(Index slot);

private:
    std::vector<Index> next_, places_;
};

/// Numbers the vertices of what is left.
/// \param faces      slots that are left, in order
/// \param triangles  of vertex slots that are left, one per face
/// \param positions  of all vertex slots
/// \throws what the poll throws.
/// O(n)
Reduced reduced(std::vector<Index> faces, std::vector<Triangle> triangles,
                std::span<const engine::Vector3> positions, SlotTrace& trace, engine::Poll poll = {});

/// What an engine has left.
/// \param trace  of its collapses.
/// \throws what the poll throws.
/// O(n)
Reduced reduced(const engine::Complex& complex, SlotTrace& trace, engine::Poll poll = {});

}  // namespace detail
FAQEM_NAMESPACE_END

#ifdef FAQEM_HEADER_ONLY
#include "faqem/detail/simplify/compaction-inl.hpp"
#endif
