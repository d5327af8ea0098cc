#pragma once
/// \file
/// The texel loop: colours for one page of the atlas.

#include <span>
#include <vector>

#include "bake/job.hpp"
#include "bake/page_atlas.hpp"
#include "bake/source_surface.hpp"

namespace faqem::detail {

/// What is on a page.
struct PageRequest {
    const Atlas& atlas;
    std::span<const AtlasChart> charts;
    std::span<const ChartTile> tiles;               ///< of the charts
    std::span<const std::array<Across, 3>> across;  ///< by triangle of the atlas
    std::span<const PageFace> faces;                ///< by triangle of the atlas
    Channels channels;
    AlphaMode alpha_mode = AlphaMode::opaque;
};

/// The page's images; those not asked for have no pixels.
struct PageImages {
    Pixels base, occlusion_roughness_metallic, emissive;
};

/// Averages options.bake.samples^2 samples per texel, in linear light and premultiplied, encodes once, and
/// fills the rest. Texels outside a triangle show what lies across the edge: the mesh neighbour unfolded into
/// the triangle's plane, so that coarser mip levels average what they would on an unbroken texture; the
/// triangle's closest point where there is none. Cells and tiles are independent of each other,
/// so the result does not depend on the number of threads. \param done, total  cells and tiles, for the
/// progress
/// \throws Cancelled
PageImages bake_page(const BakeJob& job, const SourceSurface& surface, const PageRequest& request,
                     double done, double total);

}  // namespace faqem::detail
