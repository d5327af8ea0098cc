#pragma once
/// \file
/// The texel loop: colours for one page of the atlas.

#include <span>
#include <vector>

#include "bake/texture/bake_job.hpp"
#include "bake/texture/page_atlas.hpp"
#include "bake/transfer/extension_layers.hpp"
#include "bake/transfer/source_surface.hpp"

namespace faqem::detail {

/// What is on a page.
struct PageRequest {
    const Atlas& atlas;
    std::span<const AtlasChart> charts;
    std::span<const ChartTile> tiles;                           ///< of the charts
    std::span<const std::array<AdjacentTriangle, 3>> adjacent;  ///< by triangle of the atlas
    std::span<const PageFace> faces;                            ///< by triangle of the atlas
    /// By part and corner, as they are written; needed for normal maps.
    std::span<const std::vector<Vec4f>> tangents;
    Channels channels;
    AlphaMode alpha_mode = AlphaMode::opaque;
    std::span<const ExtensionLayer> layers = {};  ///< of `material`
    Index material = no_index;                    ///< whose extensions these are
};

/// The page's images; those not asked for have no pixels.
struct PageImages {
    Pixels base, occlusion_roughness_metallic, emissive, normal;
    std::vector<Pixels> layers;                 ///< as asked for
    std::array<std::uint64_t, 3> samples = {};  ///< by MapStep
    std::uint64_t uncertain_texels = 0;         ///< with a sample found other than by MapStep::history
    std::uint64_t texels = 0;                   ///< that show a triangle
    std::vector<TexelOrigin> origins;           ///< by texel; empty unless they are recorded
};

/// Averages options.bake.samples^2 samples per texel, in linear light and premultiplied, encodes once, and
/// fills the rest. Texels outside a triangle show what lies across the edge: the mesh neighbour unfolded into
/// the triangle's plane, so that coarser mip levels average what they would on an unbroken texture; the
/// triangle's closest point where there is none. Normals are averaged in the tangent space of the simplified mesh;
/// texels outside a triangle use that of its closest point. Cells and tiles are independent of each other, so
/// the result does not depend on the number of threads.
/// \param done, total  cells and tiles, for the progress
/// \throws Cancelled
PageImages bake_page(const BakeJob& job, const SourceSampler& sampler, const PageRequest& request,
                     double done, double total);

}  // namespace faqem::detail
