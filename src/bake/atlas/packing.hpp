#pragma once
/// \file
/// Packing of charts on a page, as masks of blocks without overlap.

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "bake/atlas/chart.hpp"
#include "bake/atlas/occupancy_grid.hpp"
#include "bake/atlas/per_triangle.hpp"
#include "faqem/detail/base/parallel.hpp"

namespace faqem::detail {

/// A chart on its page, and the texels that belong to it. These are given in blocks of block_size x
/// block_size texels, so that every texel of mip level log2(block_size) belongs to one chart only.
struct AtlasChart {
    std::uint32_t x = 0, y = 0;    ///< of the first block, in texels; multiples of `block_size`
    std::uint32_t block_size = 1;  ///< texels, a power of two
    BlockMask mask;                ///< blocks that belong to the chart
    std::vector<Index> triangles;  ///< ascending
    bool is_single_texel = false;  ///< the whole chart is one texel
    /// It has all triangles of a page whose UVs are given: they may be mirrored, and neighbours be far from each other.
    bool is_given = false;

    /// Whether a texel inside the rectangle of blocks belongs to the chart.
    bool owns(std::uint32_t texel_x, std::uint32_t texel_y) const {
        return mask((texel_x - x) / block_size, (texel_y - y) / block_size);
    }
};

/// A page of charts.
struct ChartPage {
    Atlas atlas;  ///< without cells
    std::vector<AtlasChart> charts;
};

/// Places all charts on the smallest page on which they fit at the wanted sizes, and then takes the largest
/// scale that fits on this page (with an accuracy of 1%), at most sqrt(2). If the largest page is too small,
/// the scale is below 1.
/// Charts are rotated so that their bounding boxes have minimum area. A chart longer than the page is
/// compressed along this axis; one with coordinates that are not finite or beyond 1e100 becomes one texel.
/// A chart owns the blocks that a bilinear read inside it touches on the mip level whose texels are blocks.
/// Larger charts have larger blocks, up to 16 texels. Charts are placed in descending order of block size,
/// each in the first free row, in one of up to four rotations.
/// \param charts    all charts of the page
/// \param faces     number of faces of all charts together
/// \param max_size  largest width and height in texels, a power of two
/// \param context   checked for each chart in each attempt. With several threads attempts are made ahead of time; the
///                  result does not depend on their number.
/// \return nothing if there are more charts than texels
/// \throws whatever `context` throws
std::optional<ChartPage> pack_charts(std::span<const Chart> charts, std::size_t faces, std::uint32_t max_size,
                                     const RunContext& context = {});

}  // namespace faqem::detail
