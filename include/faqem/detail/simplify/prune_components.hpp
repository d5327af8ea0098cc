#pragma once
/// \file
/// Topology::prune: small components go before anything else happens.

#include <cstdint>
#include <span>
#include <vector>

#include "faqem/engine/util/cancellation.hpp"
#include "faqem/export.hpp"
#include "faqem/mesh.hpp"
#include "faqem/options.hpp"

FAQEM_NAMESPACE_BEGIN
namespace detail {

/// A face that was taken out.
struct PrunedFace {
    Index face = no_index;
    Triangle corners = {no_index, no_index, no_index};  ///< what it was
};

/// What prune() took.
struct PruneResult {
    std::vector<PrunedFace> faces;  ///< ascending
    std::uint64_t components = 0;
};

/// Takes the components (faces joined by shared vertices) whose box has a smaller diagonal than `size`. The
/// largest one (the first of equals) stays, and so do those with a locked vertex. O(faces + vertices)
/// \param positions  finite, model units
/// \param locked     empty, or one per vertex
/// \param triangles  three no_index: no face, which is also what those become that are taken
/// \param size       finite and > 0; a share is one of the diagonal of all faces' box
/// \throws what the poll throws
PruneResult prune(std::span<const Vec3> positions, std::span<const std::uint8_t> locked, const Length& size,
                  std::vector<Triangle>& triangles, engine::CancellationCheck check_cancelled = {});

}  // namespace detail
FAQEM_NAMESPACE_END

#ifdef FAQEM_HEADER_ONLY
#include "faqem/detail/simplify/prune_components-inl.hpp"
#endif
