#pragma once
/// \file
/// Input and output of the texel loop.

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "bake/page/page_layout.hpp"
#include "bake/page/page_mesh.hpp"
#include "bake/parts/corners.hpp"
#include "bake/source/extension_layers.hpp"
#include "bake/source/source_sampler.hpp"
#include "faqem/asset.hpp"
#include "faqem/bake.hpp"
#include "faqem/options.hpp"

namespace faqem::detail {

/// A page to be baked. All that it refers to must outlive it.
struct PageRequest {
    std::span<const BakePart> parts;  ///< those of the faces have maps and normals
    const SourceSampler& sampler;
    const PageMesh& mesh;
    const PageLayout& layout;  ///< of `mesh`
    /// By part and corner, as they will be written; empty for parts without a normal map.
    std::span<const std::vector<Vec4f>> tangents;
    Channels channels;  ///< those that get an image
    AlphaMode alpha_mode = AlphaMode::opaque;
    std::span<const ExtensionLayer> layers = {};  ///< of `material`
    Index material = no_index;                    ///< of the source, with the extensions of `layers`
    std::uint32_t samples = 1;                    ///< of each texel along each axis
    bool records_origins = false;                 ///< whether PageImages::origins is wanted

    /// Number of texels.
    std::size_t texels() const { return std::size_t{layout.atlas.width} * layout.atlas.height; }
};

/// The images of a page. Channels that were not requested have no pixels.
struct PageImages {
    Pixels base, normal;
    std::array<Pixels, plain_images.size()> plain;  ///< by image of `plain_images`
    std::vector<Pixels> layers;                     ///< by PageRequest::layers
    std::array<std::uint64_t, 3> samples = {};      ///< number of samples by MapStep
    std::uint64_t uncertain_texels = 0;             ///< texels with a sample not found by MapStep::history
    std::uint64_t missing_texels = 0;               ///< known texels without any point of the source
    std::uint64_t texels = 0;                       ///< texels that show a triangle
    std::vector<std::uint8_t> known;  ///< by texel: nonzero if a triangle shows it, see shown_texels()
    /// By texel: nonzero if `layers` are known. Empty without layers.
    std::vector<std::uint8_t> known_layers;
    std::vector<TexelOrigin> origins;  ///< by texel; empty unless PageRequest::records_origins
};

}  // namespace faqem::detail
