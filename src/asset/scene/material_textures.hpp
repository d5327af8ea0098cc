#pragma once
/// \file
/// The textures of a material: those of glTF itself, and those of material extensions with what their
/// channels hold (Khronos, glTF 2.0 extension registry).

#include <algorithm>
#include <array>
#include <string_view>

#include "faqem/asset.hpp"

namespace faqem::detail {

/// Meaning of the channels of a texture.
enum class TextureContent {
    data,             ///< linear values in RGB
    alpha,            ///< linear value in alpha
    color,            ///< sRGB colour
    color_and_alpha,  ///< sRGB colour, linear value in alpha
    normal,           ///< tangent-space normal
};

/// Whether the texture has sRGB colours.
constexpr bool is_color(TextureContent content) {
    return content == TextureContent::color || content == TextureContent::color_and_alpha;
}

/// A texture of a material extension.
struct KnownTexture {
    std::string_view extension, name;
    TextureContent content;
    /// Name of the factor that the texture is multiplied by, if the default of the factor is 0; else empty.
    /// Without the texture, such a factor would apply the effect to the whole surface.
    std::string_view enabling_factor;
};

/// All known textures, sorted by extension and name.
inline constexpr std::array known_textures = {
    KnownTexture{"KHR_materials_clearcoat", "clearcoatNormalTexture", TextureContent::normal, ""},
    KnownTexture{"KHR_materials_clearcoat", "clearcoatRoughnessTexture", TextureContent::data, ""},
    KnownTexture{"KHR_materials_clearcoat", "clearcoatTexture", TextureContent::data, "clearcoatFactor"},
    KnownTexture{"KHR_materials_diffuse_transmission", "diffuseTransmissionColorTexture",
                 TextureContent::color, ""},
    KnownTexture{"KHR_materials_diffuse_transmission", "diffuseTransmissionTexture", TextureContent::alpha,
                 "diffuseTransmissionFactor"},
    KnownTexture{"KHR_materials_iridescence", "iridescenceTexture", TextureContent::data,
                 "iridescenceFactor"},
    KnownTexture{"KHR_materials_iridescence", "iridescenceThicknessTexture", TextureContent::data, ""},
    KnownTexture{"KHR_materials_pbrSpecularGlossiness", "diffuseTexture", TextureContent::color_and_alpha,
                 ""},
    KnownTexture{"KHR_materials_pbrSpecularGlossiness", "specularGlossinessTexture",
                 TextureContent::color_and_alpha, ""},
    KnownTexture{"KHR_materials_sheen", "sheenColorTexture", TextureContent::color, "sheenColorFactor"},
    KnownTexture{"KHR_materials_sheen", "sheenRoughnessTexture", TextureContent::alpha, ""},
    KnownTexture{"KHR_materials_specular", "specularColorTexture", TextureContent::color, ""},
    KnownTexture{"KHR_materials_specular", "specularTexture", TextureContent::alpha, ""},
    KnownTexture{"KHR_materials_transmission", "transmissionTexture", TextureContent::data,
                 "transmissionFactor"},
    KnownTexture{"KHR_materials_volume", "thicknessTexture", TextureContent::data, "thicknessFactor"},
};

/// Finds a texture by extension and name; null if it is not known.
inline const KnownTexture* find_known_texture(std::string_view extension, std::string_view name) {
    const auto found = std::find_if(
        known_textures.begin(), known_textures.end(),
        [&](const KnownTexture& known) { return known.extension == extension && known.name == name; });
    return found == known_textures.end() ? nullptr : &*found;
}

/// Calls visit(texture) for the five textures of glTF's material, in a fixed order, whether they are set or
/// not.
/// \param material  Material or const Material
template <class M, class Visit>
void for_each_core_texture(M& material, const Visit& visit) {
    visit(material.base_color_texture);
    visit(material.metallic_roughness_texture);
    visit(material.normal_texture);
    visit(material.occlusion_texture);
    visit(material.emissive_texture);
}

/// Calls visit(texture) as for_each_core_texture() does, then for the textures of extensions.
template <class M, class Visit>
void for_each_texture(M& material, const Visit& visit) {
    for_each_core_texture(material, visit);
    for (auto& extension : material.extension_textures) visit(extension.texture);
}

/// Whether a material refers to an image.
inline bool has_textures(const Material& material) {
    bool result = false;
    for_each_texture(material, [&](const TextureRef& texture) { result = result || texture; });
    return result;
}

}  // namespace faqem::detail
