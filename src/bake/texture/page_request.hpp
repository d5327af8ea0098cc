#pragma once
/// \file
/// Input of the texel loop.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "bake/texture/page_layout.hpp"
#include "bake/texture/page_mesh.hpp"
#include "bake/transfer/corners.hpp"
#include "bake/transfer/extension_layers.hpp"
#include "bake/transfer/source_sampler.hpp"
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

}  // namespace faqem::detail
