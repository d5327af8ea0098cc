#pragma once
/// \file
/// Topology::prune: removal of small connected components before the simplification.

#include <cstdint>
#include <span>
#include <vector>

#include "faqem/export.hpp"
#include "faqem/mesh.hpp"
#include "faqem/option_types.hpp"

FAQEM_DETAIL_BEGIN

/// The corners of a face that was removed.
inline constexpr Triangle no_corners = {no_index, no_index, no_index};

/// A removed face.
struct PrunedFace {
    Index face = no_index;
    Triangle corners = no_corners;  ///< its corners before the removal
};

/// The faces that prune() removed.
struct PruneResult {
    std::vector<PrunedFace> faces;  ///< ascending by face
    std::uint64_t components = 0;   ///< number of removed components
};

/// Removes connected components (faces joined by shared vertices) whose bounding box has a smaller diagonal
/// than `size`. The component with the largest box (the first one of equals) and components with a locked
/// vertex are kept.
/// \param positions  one per vertex, finite, model units
/// \param locked     empty, or one per vertex; nonzero: locked
/// \param triangles  changed in place: the corners of removed faces become no_index. Faces with no_index
///                   corners are ignored.
/// \param size       finite and > 0; Length::Unit::diagonal refers to the bounding box of all faces
/// \return the removed faces
/// Complexity: O(faces + vertices)
PruneResult prune(std::span<const Vec3> positions, std::span<const std::uint8_t> locked, const Length& size,
                  std::vector<Triangle>& triangles);

FAQEM_DETAIL_END

#ifdef FAQEM_HEADER_ONLY
#include "faqem/detail/simplify/prune_components-inl.hpp"
#endif
