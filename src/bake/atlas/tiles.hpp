#pragma once
/// \file
/// Tiles of charts, and the triangle that every sample of a tile belongs to.

#include <cstdint>
#include <span>
#include <vector>

#include "bake/atlas/packing.hpp"

namespace faqem::detail {

/// A rectangle of texels of one chart, baked as one unit of work.
struct ChartTile {
    Index chart = 0;                                    ///< index into the charts of the page
    std::uint32_t x = 0, y = 0, width = 0, height = 0;  ///< texels
};

/// Splits the rectangles of charts into tiles of at most 64 x 64 texels. Tiles without any block of their
/// chart are left out.
std::vector<ChartTile> split_into_tiles(std::span<const AtlasChart> charts);

/// The triangle of every sample of a tile.
struct TileOwners {
    std::vector<Index> triangles;  ///< triangles with samples in the tile: indices into the atlas, ascending
    /// By sample, row by row: index into `triangles`, or `none` outside the chart's blocks.
    std::vector<std::uint32_t> owners;
    static constexpr std::uint32_t none = 0xffffffff;
};

/// Assigns every sample in the chart's blocks to the triangle that contains it, otherwise (the gutter) to the
/// triangle with the closest edge on the chart's boundary. Ties are resolved by the smallest index.
/// \param atlas     placements of the triangles
/// \param chart     the chart that the tile is part of
/// \param triangles  the triangles of the atlas
/// \param tile      one of split_into_tiles()
/// \param samples   samples per texel along each axis
TileOwners tile_owners(const Atlas& atlas, const AtlasChart& chart, std::span<const PageTriangle> triangles,
                       const ChartTile& tile, std::uint32_t samples);

}  // namespace faqem::detail
