#include "bake/transfer/extension_layers.hpp"

#include <algorithm>
#include <optional>

namespace faqem::detail {
namespace {

// What a layer of one content holds when it takes in another; none where it cannot.
std::optional<TextureContent> joined(TextureContent a, TextureContent b) {
    const auto is_coloured = [](TextureContent c) {
        return c == TextureContent::colour || c == TextureContent::alpha ||
               c == TextureContent::colour_and_alpha;
    };
    if (a == b) return a;
    if (is_coloured(a) && is_coloured(b)) return TextureContent::colour_and_alpha;
    return std::nullopt;
}

}  // namespace

Encoding ExtensionLayer::encoding() const {
    return content == TextureContent::colour || content == TextureContent::colour_and_alpha
               ? Encoding::colour_and_number
               : Encoding::data;
}

std::vector<ExtensionLayer> extension_layers(const Material& material) {
    std::vector<ExtensionLayer> result;
    for (Index i = 0; i < material.extension_textures.size(); ++i) {
        const ExtensionTexture& texture = material.extension_textures[i];
        const KnownTexture* known = find_known_texture(texture.extension, texture.name);
        if (!known || !texture.texture) continue;
        const bool is_normal = known->content == TextureContent::normal;
        const float scale = is_normal ? texture.normal_scale : 1;
        const auto layer = std::find_if(result.begin(), result.end(), [&](const ExtensionLayer& l) {
            return l.use == texture.texture && l.normal_scale == scale && joined(l.content, known->content);
        });
        if (layer == result.end()) {
            result.push_back({known->content, texture.texture, scale, {i}});
        } else {
            layer->content = *joined(layer->content, known->content);
            layer->textures.push_back(i);
        }
    }
    return result;
}

const TextureRef* tangent_texture(const Material& material) {
    if (material.normal_texture) return &material.normal_texture;
    for (const ExtensionTexture& texture : material.extension_textures) {
        const KnownTexture* known = find_known_texture(texture.extension, texture.name);
        if (known && known->content == TextureContent::normal && texture.texture) return &texture.texture;
    }
    return nullptr;
}

}  // namespace faqem::detail
