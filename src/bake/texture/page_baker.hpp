#pragma once
/// \file
/// The texel loop: bakes the images of one page of the atlas.

#include <span>
#include <vector>

#include "bake/texture/bake_job.hpp"
#include "bake/texture/page_atlas.hpp"
#include "bake/transfer/extension_layers.hpp"
#include "bake/transfer/source_sampler.hpp"

namespace faqem::detail {

/// A page to be baked.
struct PageRequest {
    const Atlas& atlas;
    std::span<const AtlasChart> charts;
    std::span<const ChartTile> tiles;                           ///< of the charts
    std::span<const std::array<AdjacentTriangle, 3>> adjacent;  ///< by triangle of the atlas
    std::span<const PageFace> faces;                            ///< by triangle of the atlas
    /// By part and corner, as they will be written; needed for normal maps.
    std::span<const std::vector<Vec4f>> tangents;
    Channels channels;
    AlphaMode alpha_mode = AlphaMode::opaque;
    std::span<const ExtensionLayer> layers = {};  ///< of `material`
    Index material = no_index;                    ///< of the source, with the extensions of `layers`
};

/// The images of a page. Channels that were not requested have no pixels.
struct PageImages {
    Pixels base, occlusion_roughness_metallic, emissive, normal;
    std::vector<Pixels> layers;                 ///< by PageRequest::layers
    std::array<std::uint64_t, 3> samples = {};  ///< number of samples by MapStep
    std::uint64_t uncertain_texels = 0;         ///< texels with a sample not found by MapStep::history
    std::uint64_t texels = 0;                   ///< texels that show a triangle
    std::vector<std::uint8_t> known;  ///< by texel: nonzero if a triangle shows it, see shown_texels()
    /// By texel: nonzero if `layers` are known. Empty without layers.
    std::vector<std::uint8_t> known_layers;
    std::vector<TexelOrigin> origins;  ///< by texel; empty unless options.bake.correspondence is on
};

/// Bakes the images of a page.
/// A texel is the average of options.bake.samples^2 samples in linear light with premultiplied alpha, and is
/// encoded once. The other texels are filled by push_pull().
/// Samples outside a triangle show the mesh neighbour across the edge, unfolded into the triangle's plane, so
/// that coarser mip levels have the averages of a continuous texture; where there is no neighbour, they show
/// the triangle's closest point. Normals are averaged in the tangent space of the simplified mesh; samples
/// outside a triangle use the tangent space of its closest point.
/// The result does not depend on the number of threads, as cells and tiles are independent of each other.
/// \param done   cells and tiles of other pages that were baked before, for the progress
/// \param total  cells and tiles of all pages
/// \throws Cancelled if the progress callback cancels, and whatever the callback throws
PageImages bake_page(const BakeJob& job, const SourceSampler& sampler, const PageRequest& request,
                     double done, double total);

}  // namespace faqem::detail
