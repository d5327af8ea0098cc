#pragma once
/// \file
/// Makes the atlas of a page: adjacency, texel densities and layout of its faces.

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "bake/atlas/per_triangle.hpp"
#include "bake/atlas/tiles.hpp"
#include "bake/atlas/triangle_pairs.hpp"
#include "bake/texture/bake_job.hpp"
#include "bake/transfer/source_sampler.hpp"

namespace faqem::detail {

/// A face of a simplified mesh.
struct PageFace {
    Index part = 0, face = 0;
};

/// An atlas, and the mesh adjacency of its triangles.
struct PageAtlas {
    Atlas atlas;
    std::vector<AtlasChart> charts;
    std::vector<ChartTile> tiles;                           ///< of the charts
    std::vector<std::array<AdjacentTriangle, 3>> adjacent;  ///< by triangle and corner opposite the edge
    BakedPage summary;  ///< report entry, with what is known before baking

    /// Number of cells and tiles, which are the units of work.
    std::size_t pieces() const { return atlas.cells.size() + tiles.size(); }
};

/// Neighbours of the page's faces, across edges with exactly two faces of consistent winding.
/// \param faces  the faces of the page
/// \return by face and corner opposite the edge
/// Complexity: O(n log n).
std::vector<std::array<AdjacentTriangle, 3>> face_adjacency(const BakeJob& job,
                                                            std::span<const PageFace> faces);

/// Makes the atlas of a page, of the kind given by options.bake.kind, with texel densities taken from the
/// source. Bake::automatic uses charts unless they have fewer than 3 faces on average.
/// \param faces  the faces of the page; those of one part must be consecutive
/// \return nothing if there are more charts than texels or, for an atlas by triangle, more triangles
std::optional<PageAtlas> make_page_atlas(const BakeJob& job, const SourceSampler& sampler,
                                         std::span<const PageFace> faces);

}  // namespace faqem::detail
