#pragma once
/// \file
/// The textures of a material: those of glTF itself, and those of material extensions with what their
/// channels hold (Khronos, glTF 2.0 extension registry).

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "faqem/asset.hpp"
#include "faqem/export.hpp"

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
inline constexpr auto known_textures = std::to_array<KnownTexture>({
    {"KHR_materials_clearcoat", "clearcoatNormalTexture", TextureContent::normal, ""},
    {"KHR_materials_clearcoat", "clearcoatRoughnessTexture", TextureContent::data, ""},
    {"KHR_materials_clearcoat", "clearcoatTexture", TextureContent::data, "clearcoatFactor"},
    {"KHR_materials_diffuse_transmission", "diffuseTransmissionColorTexture", TextureContent::color, ""},
    {"KHR_materials_diffuse_transmission", "diffuseTransmissionTexture", TextureContent::alpha,
     "diffuseTransmissionFactor"},
    {"KHR_materials_iridescence", "iridescenceTexture", TextureContent::data, "iridescenceFactor"},
    {"KHR_materials_iridescence", "iridescenceThicknessTexture", TextureContent::data, ""},
    {"KHR_materials_pbrSpecularGlossiness", "diffuseTexture", TextureContent::color_and_alpha, ""},
    {"KHR_materials_pbrSpecularGlossiness", "specularGlossinessTexture", TextureContent::color_and_alpha, ""},
    {"KHR_materials_sheen", "sheenColorTexture", TextureContent::color, "sheenColorFactor"},
    {"KHR_materials_sheen", "sheenRoughnessTexture", TextureContent::alpha, ""},
    {"KHR_materials_specular", "specularColorTexture", TextureContent::color, ""},
    {"KHR_materials_specular", "specularTexture", TextureContent::alpha, ""},
    {"KHR_materials_transmission", "transmissionTexture", TextureContent::data, "transmissionFactor"},
    {"KHR_materials_volume", "thicknessTexture", TextureContent::data, "thicknessFactor"},
});

/// Finds a texture by extension and name; null if it is not known.
inline const KnownTexture* find_known_texture(std::string_view extension, std::string_view name) {
    const auto found = std::ranges::find_if(known_textures, [&](const KnownTexture& known) {
        return known.extension == extension && known.name == name;
    });
    return found == known_textures.end() ? nullptr : &*found;
}

/// The textures of glTF's material, as numbers of rows of core_slots.
enum class CoreTexture : std::uint8_t { base_color, metallic_roughness, normal, occlusion, emissive };

/// The images with values in RGB that core textures are baked to. Base colours and normals, which are no plain values,
/// have images of their own.
inline constexpr std::size_t orm_image = 0;  ///< occlusion, roughness and metalness
inline constexpr std::size_t emissive_image = 1;
inline constexpr std::array plain_images = {TextureContent::data, TextureContent::color};  ///< their contents
inline constexpr std::size_t own_image = plain_images.size();                              ///< none of them

/// A texture of glTF's material.
struct CoreSlot {
    TextureRef Material::*texture;
    const char* key;                    ///< in glTF
    bool is_in_pbr;                     ///< whether it is a member of pbrMetallicRoughness
    const char* title;                  ///< for messages
    TextureContent content;             ///< the alpha of base colours is unused in opaque materials
    std::size_t image;                  ///< of `plain_images`
    float Material::*factor = nullptr;  ///< a member of the texture in glTF, 1 if it is not set; null: none
    const char* factor_key = "";
};

/// By CoreTexture.
inline constexpr std::array core_slots = {
    CoreSlot{&Material::base_color_texture, "baseColorTexture", true, "base colour",
             TextureContent::color_and_alpha, own_image},
    CoreSlot{&Material::metallic_roughness_texture, "metallicRoughnessTexture", true, "metallic-roughness",
             TextureContent::data, orm_image},
    CoreSlot{&Material::normal_texture, "normalTexture", false, "normal", TextureContent::normal, own_image,
             &Material::normal_scale, "scale"},
    CoreSlot{&Material::occlusion_texture, "occlusionTexture", false, "occlusion", TextureContent::data,
             orm_image, &Material::occlusion_strength, "strength"},
    CoreSlot{&Material::emissive_texture, "emissiveTexture", false, "emissive", TextureContent::color,
             emissive_image},
};

/// Finds a texture of glTF's material by its key; null if there is none.
inline const CoreSlot* find_core_slot(std::string_view key) {
    const auto found = std::ranges::find(core_slots, key, &CoreSlot::key);
    return found == core_slots.end() ? nullptr : &*found;
}

/// Calls visit(texture) for the textures of a material, whether they are set or not: in the order of core_slots, then
/// those of extensions.
/// \param material  Material or const Material
template <class M, class Visit>
void for_each_texture(M& material, const Visit& visit) {
    for (const CoreSlot& slot : core_slots) visit(material.*slot.texture);
    for (auto& extension : material.extension_textures) visit(extension.texture);
}

/// Returns the images that materials use, each one once, in their order, and updates the references.
inline std::vector<Image> used_images(std::vector<Material>& materials, const std::vector<Image>& images) {
    std::vector<Index> number(images.size(), no_index);
    for (const Material& material : materials)
        for_each_texture(material, [&](const TextureRef& ref) {
            if (ref) number[ref.image] = 0;
        });
    std::vector<Image> used;
    for (std::size_t i = 0; i < number.size(); ++i) {
        if (number[i] == no_index) continue;
        number[i] = static_cast<Index>(used.size());
        used.push_back(images[i]);
    }
    for (Material& material : materials)
        for_each_texture(material, [&](TextureRef& ref) {
            if (ref) ref.image = number[ref.image];
        });
    return used;
}

/// Whether the file of an asset names materials, textures and images by number (VRM), so that a result must keep all of
/// them in their order.
FAQEM_EXPORT bool names_objects_by_number(const Asset& asset);

/// Gives an asset whose materials are those of another one, with new textures, what save() writes of them from the file
/// of the other one: extras and extensions. \pre not names_objects_by_number(to)
FAQEM_EXPORT void carry_materials(const Asset& from, Asset& to);

/// Removes all textures of a material, with what only applies to them.
inline void remove_textures(Material& material) {
    for (const CoreSlot& slot : core_slots) {
        material.*slot.texture = {};
        if (slot.factor) material.*slot.factor = 1;
    }
    material.extension_textures.clear();
}

/// Whether a material refers to a certain image.
inline bool uses_image(const Material& material, Index image) {
    bool result = false;
    for_each_texture(material, [&](const TextureRef& texture) { result = result || texture.image == image; });
    return result;
}

/// Whether a material refers to an image.
inline bool has_textures(const Material& material) {
    bool result = false;
    for_each_texture(material, [&](const TextureRef& texture) { result = result || texture; });
    return result;
}

/// The material with the given index. For `no_index` the default material: that of glTF, which is metal, in scenes that
/// were read from glTF, otherwise one that is no metal, since other formats have none.
inline const Material& material_or_default(const Asset& asset, Index material) {
    static const Material gltf;
    static const Material plain = [] {
        Material result;
        result.metallic = 0;
        return result;
    }();
    if (material != no_index) return asset.materials[material];
    return asset.source ? gltf : plain;
}

}  // namespace faqem::detail
