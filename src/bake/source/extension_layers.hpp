#pragma once
/// \file
/// Layers of a page for the textures of a material's extensions.

#include <vector>

#include "asset/scene/material_textures.hpp"
#include "render/texture_sampling.hpp"

namespace faqem::detail {

/// An image of the page for one or more textures of a material's extensions.
struct ExtensionLayer {
    TextureContent content;
    TextureRef texture_ref;  ///< of the source
    float normal_scale = 1;
    std::vector<Index> textures;  ///< indices into Material::extension_textures, at least one

    bool is_normal_map() const { return content == TextureContent::normal; }
    bool has_color() const { return content != TextureContent::alpha; }
    bool has_alpha() const {
        return content == TextureContent::alpha || content == TextureContent::color_and_alpha;
    }
    TexelEncoding encoding() const;
};

/// The layers of a material. Textures with the same image, transform and sampler share a layer if its
/// channels can hold the contents of both. Textures of unknown extensions have no layer.
/// Complexity: O(textures^2).
std::vector<ExtensionLayer> extension_layers(const Material& material);

/// The texture that the tangents of a material are for: its normal map, otherwise the first normal map of its
/// extensions. Null if there is none.
const TextureRef* tangent_texture(const Material& material);

}  // namespace faqem::detail
