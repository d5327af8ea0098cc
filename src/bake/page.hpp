#pragma once
/// \file
/// The texel loop: colours for one page of the atlas.

#include <span>
#include <vector>

#include "bake/atlas_per_triangle.hpp"
#include "bake/job.hpp"
#include "bake/source_surface.hpp"

namespace faqem::detail {

/// A face of a small mesh.
struct PageFace {
    Index part = 0, face = 0;
};

/// What is on a page.
struct PageRequest {
    const Atlas& atlas;
    std::span<const PageFace> faces;  ///< by triangle of the atlas
    Channels channels;
    AlphaMode alpha_mode = AlphaMode::opaque;
};

/// The page's images; those not asked for have no pixels.
struct PageImages {
    Pixels base, occlusion_roughness_metallic, emissive;
};

/// Averages options.bake.samples^2 samples per texel, in linear light and premultiplied, encodes once, and
/// fills the rest. Texels outside a triangle repeat its closest point. Cells are independent of each other,
/// so the result does not depend on the number of threads. \param done, total  texels, for the progress
/// \throws Cancelled
PageImages bake_page(const BakeJob& job, const SourceSurface& surface, const PageRequest& request,
                     double done, double total);

}  // namespace faqem::detail
