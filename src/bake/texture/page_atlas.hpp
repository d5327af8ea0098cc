#pragma once
/// \file
/// From the faces of a page to its atlas: who is whose neighbour, how large, in which order.

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "bake/atlas/per_triangle.hpp"
#include "bake/atlas/tiles.hpp"
#include "bake/atlas/triangle_pairs.hpp"
#include "bake/texture/bake_job.hpp"
#include "bake/transfer/source_surface.hpp"

namespace faqem::detail {

/// A face of a simplified mesh.
struct PageFace {
    Index part = 0, face = 0;
};

/// An atlas, and the neighbours in the mesh by triangle.
struct PageAtlas {
    Atlas atlas;
    std::vector<AtlasChart> charts;
    std::vector<ChartTile> tiles;  ///< of the charts
    std::vector<std::array<AdjacentTriangle, 3>> adjacent;
    BakedPage summary;  ///< what can be told before it is baked

    std::size_t pieces() const { return atlas.cells.size() + tiles.size(); }
};

/// Neighbours of the page's faces: over edges with exactly two of them, wound alike. O(n log n)
std::vector<std::array<AdjacentTriangle, 3>> face_adjacency(const BakeJob& job,
                                                            std::span<const PageFace> faces);

/// Wants the source's texels per length of each face, and makes the atlas that options.bake.kind says.
/// `automatic` takes charts unless they hold fewer than 3 faces on average.
/// \param faces  those of a part are consecutive
/// \return nothing if there are more pieces than texels
std::optional<PageAtlas> make_page_atlas(const BakeJob& job, const SourceSampler& sampler,
                                         std::span<const PageFace> faces);

}  // namespace faqem::detail
