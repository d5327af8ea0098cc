#pragma once
/// \file
/// Places the triangles of a page: as charts, or each by itself.

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "bake/atlas/packing.hpp"
#include "bake/atlas/per_triangle.hpp"
#include "bake/atlas/tiles.hpp"
#include "bake/page/page_mesh.hpp"
#include "faqem/detail/base/parallel.hpp"
#include "faqem/options.hpp"
#include "faqem/report.hpp"

namespace faqem::detail {

/// Where the triangles of a page are, and the pieces of it that are baked by themselves: cells of the atlas with one or
/// two triangles each, or tiles of charts.
struct PageLayout {
    Atlas atlas;
    std::vector<AtlasChart> charts;
    std::vector<ChartTile> tiles;  ///< of the charts
    BakedPage summary;             ///< report entry, with what is known before baking

    std::size_t pieces() const { return atlas.cells.size() + tiles.size(); }
};

/// Places the triangles of a page.
/// \param kind          Bake::atlas, Bake::per_triangle or Bake::automatic: charts, unless they have fewer than 3
///                      triangles on average
/// \param texture_size  largest width and height of the page in texels, a power of two
/// \param given         by triangle: its UVs, in [0, 1]; empty: new ones. The page has the smallest size with the wanted
///                      density
/// \return nothing if there are more charts than texels or, for an atlas by triangle, more triangles
/// \throws whatever `context` throws
/// Complexity: that of make_charts() and pack_charts(), or of pack_triangles().
std::optional<PageLayout> layout_page(const PageMesh& mesh, std::span<const Triangle2> given, Bake kind,
                                      std::uint32_t texture_size, const RunContext& context);

}  // namespace faqem::detail
