#pragma once
/// \file
/// The images that a material's extension textures become on a page.

#include <vector>

#include "asset/known_textures.hpp"
#include "bake/transfer/texture_sampling.hpp"

namespace faqem::detail {

/// One image on the page, for one or more textures of a material's extensions.
struct ExtensionLayer {
    TextureContent content;
    TextureRef texture_ref;  ///< of the source's image
    float normal_scale = 1;
    std::vector<Index> textures;  ///< into Material::extension_textures, at least one

    bool is_normal_map() const { return content == TextureContent::normal; }
    bool has_color() const { return content != TextureContent::alpha; }
    bool has_alpha() const {
        return content == TextureContent::alpha || content == TextureContent::color_and_alpha;
    }
    TexelEncoding encoding() const;
};

/// Textures that show the same image in the same way share a layer where its channels can mean both.
/// Textures that nobody knows have none. O(textures^2)
std::vector<ExtensionLayer> extension_layers(const Material& material);

/// The texture that a material's tangents belong to: its normal map, else one of its extensions. Null: none.
const TextureRef* tangent_texture(const Material& material);

}  // namespace faqem::detail
