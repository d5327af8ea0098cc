#include "bake/source/extension_layers.hpp"

#include <algorithm>
#include <optional>

namespace faqem::detail {
namespace {

// Content of a layer for both contents; empty if no layer can hold both.
std::optional<TextureContent> merged_content(TextureContent a, TextureContent b) {
    const auto is_colored = [](TextureContent c) { return is_color(c) || c == TextureContent::alpha; };
    if (a == b) return a;
    if (is_colored(a) && is_colored(b)) return TextureContent::color_and_alpha;
    return std::nullopt;
}

}  // namespace

TexelEncoding ExtensionLayer::encoding() const {
    return is_color(content) ? TexelEncoding::color_and_data_alpha : TexelEncoding::data;
}

std::vector<ExtensionLayer> extension_layers(const Material& material) {
    std::vector<ExtensionLayer> result;
    for (Index i = 0; i < material.extension_textures.size(); ++i) {
        const ExtensionTexture& texture = material.extension_textures[i];
        const KnownTexture* known = find_known_texture(texture.extension, texture.name);
        if (!known || !texture.texture) continue;
        const bool is_normal_map = known->content == TextureContent::normal;
        const float scale = is_normal_map ? texture.normal_scale : 1;
        const auto layer = std::find_if(result.begin(), result.end(), [&](const ExtensionLayer& l) {
            return l.texture_ref == texture.texture && l.normal_scale == scale &&
                   merged_content(l.content, known->content);
        });
        if (layer == result.end()) {
            result.push_back({known->content, texture.texture, scale, {i}});
        } else {
            layer->content = *merged_content(layer->content, known->content);
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
