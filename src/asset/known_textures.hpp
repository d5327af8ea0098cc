#pragma once
/// \file
/// Which textures material extensions have, and what is in them (Khronos, glTF 2.0 extension registry).

#include <algorithm>
#include <array>
#include <string_view>

namespace faqem::detail {

/// What the channels of a texture say.
enum class TextureContent {
    data,             ///< numbers in RGB
    alpha,            ///< a number in alpha
    color,            ///< sRGB
    color_and_alpha,  ///< sRGB, and a number in alpha
    normal,           ///< a direction in tangent space
};

/// A texture of a material extension.
struct KnownTexture {
    std::string_view extension, name;
    TextureContent content;
    /// The factor it is multiplied with where that is 0 by default: it switches on, everywhere, what the
    /// texture has in places. Else empty.
    std::string_view enabling_factor;
};

/// By extension and name.
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

/// Null where it is not known.
inline const KnownTexture* find_known_texture(std::string_view extension, std::string_view name) {
    const auto found = std::find_if(
        known_textures.begin(), known_textures.end(),
        [&](const KnownTexture& known) { return known.extension == extension && known.name == name; });
    return found == known_textures.end() ? nullptr : &*found;
}

}  // namespace faqem::detail
