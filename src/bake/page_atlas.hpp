#pragma once
/// \file
/// From the faces of a page to its atlas: who is whose neighbour, how large, in which order.

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "bake/atlas_per_triangle.hpp"
#include "bake/job.hpp"
#include "bake/source_surface.hpp"
#include "bake/triangle_pairs.hpp"

namespace faqem::detail {

/// A face of a small mesh.
struct PageFace {
    Index part = 0, face = 0;
};

/// An atlas and its neighbours in the mesh, by triangle.
struct PageAtlas {
    Atlas atlas;
    std::vector<std::array<Across, 3>> across;
};

/// Neighbours of the page's faces: over edges with exactly two of them, wound alike. O(n log n)
std::vector<std::array<Across, 3>> neighbours(const BakeJob& job, std::span<const PageFace> faces);

/// Wants the source's texels per length of each face, pairs neighbours, and packs.
/// \param faces  those of a part are consecutive \return nothing if there are more faces than texels
std::optional<PageAtlas> make_page_atlas(const BakeJob& job, const SourceSurface& surface,
                                         std::span<const PageFace> faces);

}  // namespace faqem::detail
