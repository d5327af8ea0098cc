#pragma once
/// \file
/// Which triangle the samples of a chart belong to.

#include <cstdint>
#include <span>
#include <vector>

#include "bake/atlas/packing.hpp"

namespace faqem::detail {

/// A rectangle of texels, baked in one go.
struct ChartTile {
    Index chart = 0;  ///< into the charts of the page
    std::uint32_t x = 0, y = 0, width = 0, height = 0;
};

/// Cuts the charts' rectangles into tiles of at most 64 x 64 texels; those without a block are left out.
std::vector<ChartTile> split_into_tiles(std::span<const AtlasChart> charts);

/// Samples of a tile, samples x samples per texel.
struct TileOwners {
    std::vector<Index> triangles;  ///< those with samples here, into the atlas, ascending
    std::vector<std::uint32_t>
        owners;  ///< row by row of samples: into `triangles`; none where not the chart's
    static constexpr std::uint32_t none = 0xffffffff;
};

/// Gives every sample in the chart's blocks to the triangle that it is in, else to the closest one that has
/// an edge on the chart's outline; the first one of those that are equally close.
TileOwners tile_owners(const Atlas& atlas, const AtlasChart& chart,
                       std::span<const std::array<AdjacentTriangle, 3>> adjacent, const ChartTile& tile,
                       std::uint32_t samples);

}  // namespace faqem::detail
