#pragma once
/// \file
/// Charts on a page: masks of blocks, packed without overlap.

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "bake/atlas/chart.hpp"
#include "bake/atlas/per_triangle.hpp"
#include "faqem/engine/util/cancellation.hpp"

namespace faqem::detail {

/// A chart on its page, and the texels that are its own. In blocks of block_size x block_size texels, so that mip level
/// log2(block_size) has texels of one chart only.
struct AtlasChart {
    std::uint32_t x = 0, y = 0;              ///< of the first block, in texels; multiples of `block_size`
    std::uint32_t block_size = 1;            ///< a power of two
    std::uint32_t columns = 1, rows = 1;     ///< blocks
    std::vector<std::uint8_t> blocks = {1};  ///< row by row: nonzero where they are the chart's
    std::vector<Index> triangles;            ///< ascending
    bool is_single_texel = false;            ///< all of it is one texel

    /// Whether a texel inside the blocks' rectangle is the chart's.
    bool owns(std::uint32_t texel_x, std::uint32_t texel_y) const {
        return blocks[std::size_t{(texel_y - y) / block_size} * columns + (texel_x - x) / block_size] != 0;
    }
};

/// A page of charts.
struct ChartPage {
    Atlas atlas;  ///< no cells
    std::vector<AtlasChart> charts;
};

/// Places every chart, turned so that its box is least, on the smallest page that holds the wanted sizes;
/// then takes the largest scale that fits that page (to a hundredth), at most sqrt 2. If the largest page is
/// too small everything is scaled down. A chart longer than the page is squeezed along; one with places that
/// are not finite, or beyond 1e100, becomes one texel. A chart owns the blocks that a bilinear read inside it
/// touches on the mip level where blocks are texels; the larger the chart, the larger its blocks, 16 at most.
/// Large blocks come first; each chart goes to the lowest free place in one of four turns.
/// \param faces  of all charts together
/// \param max_size  largest width and height, a power of two
/// \return nothing if there are more charts than texels
/// \throws what the poll throws
std::optional<ChartPage> pack_charts(std::span<const Chart> charts, std::size_t faces, std::uint32_t max_size,
                                     engine::CancellationCheck check_cancelled = {});

}  // namespace faqem::detail
