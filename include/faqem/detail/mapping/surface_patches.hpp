#pragma once
/// \file
/// SurfacePatches of a triangle soup, and which of their faces are wound the wrong way round.

#include <cstdint>
#include <span>
#include <vector>

#include "faqem/engine/util/cancellation.hpp"
#include "faqem/export.hpp"
#include "faqem/mesh.hpp"

FAQEM_NAMESPACE_BEGIN
namespace detail {

/// Components over edges with exactly two faces. Edges with more faces divide surface_patches, so that the two sides
/// of a thin wall that touch in a fin stay apart. But two faces stay together that had such an edge to
/// themselves before vertices were joined: so two boxes that touch in a full side stay whole. And so do two of
/// which one continues the other (within 30 degrees), where no third face comes near to (within 60): so a
/// surface_patch goes on under a fin, and two that cross stay two.
struct SurfacePatches {
    std::vector<Index> surface_patch;  ///< per face; no_index for faces with a corner no_index
    std::vector<std::int8_t>
        sign;                  ///< per face: -1 where it is wound against most of its surface_patch (by area)
    std::vector<Index> faces;  ///< surface_patch by surface_patch, ascending within each
    std::vector<Index> begin = {0};  ///< per surface_patch: of its own in `faces`; and their end

    /// The faces of a surface_patch.
    std::span<const Index> of(Index s) const {
        return std::span(faces).subspan(begin[s], begin[s + 1] - begin[s]);
    }
};

/// \param positions  one per vertex
/// \param triangles  faces with a corner no_index are left out
/// \param unwelded   empty, or the faces as they were before vertices at one place were joined
/// O(n log n) time, 48 bytes per face while it runs.
/// \throws what the poll throws
SurfacePatches find_surface_patches(std::span<const Vec3> positions, std::span<const Triangle> triangles,
                                    std::span<const Triangle> unwelded = {},
                                    engine::CancellationCheck check_cancelled = {});

}  // namespace detail
FAQEM_NAMESPACE_END

#ifdef FAQEM_HEADER_ONLY
#include "faqem/detail/mapping/surface_patches-inl.hpp"
#endif
