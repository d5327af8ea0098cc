#include <algorithm>
#include <cmath>

#include "asset/gltf/read/load.hpp"
#include "asset/image/image.hpp"
#include "asset/scene/material_textures.hpp"
#include "asset/scene/messages.hpp"

namespace faqem::detail {
namespace {

float number_or(const Json& value, float fallback) {
    return value.is_number() ? static_cast<float>(value.get<double>()) : fallback;
}

Vec2f pair_or(const Json& pair, Vec2f fallback) {
    if (pair.size() != 2) return fallback;
    return {number_or(pair[0], fallback[0]), number_or(pair[1], fallback[1])};
}

Wrap wrap_of(const Json& sampler, const char* key) {
    const auto mode = std::ranges::find(wrap_modes, unsigned_member(sampler, key, wrap_modes[0]));
    return mode == wrap_modes.end() ? Wrap::repeat : static_cast<Wrap>(mode - wrap_modes.begin());
}

/// Converts a texture info; unset if there is none, or if the texture has no usable image.
TextureRef texture_ref(const LoadedGltf& loaded, const Json& info) {
    TextureRef ref;
    const Index index = index_member(info, "index");
    if (index == no_index) return ref;
    const Json& texture = loaded.source->document["textures"][index];
    const Index image = texture_image(texture);
    // A texture without an image is ignored. Missing images were reported when they were loaded.
    if (image == no_index || loaded.source->images[image].encoded.empty()) return ref;
    ref.image = image;
    ref.uv_set = static_cast<std::uint32_t>(unsigned_member(info, "texCoord", 0));
    if (const Index index_of_sampler = index_member(texture, "sampler"); index_of_sampler != no_index) {
        const Json& sampler = loaded.source->document["samplers"][index_of_sampler];
        ref.wrap_u = wrap_of(sampler, "wrapS");
        ref.wrap_v = wrap_of(sampler, "wrapT");
        if (unsigned_member(sampler, "magFilter", gl_linear) == gl_nearest) ref.filter = Filter::nearest;
    }
    const Json& transform = member(info, "extensions", "KHR_texture_transform");
    ref.offset = pair_or(member(transform, "offset"), ref.offset);
    ref.scale = pair_or(member(transform, "scale"), ref.scale);
    ref.rotation = number_or(member(transform, "rotation"), 0);
    ref.uv_set = static_cast<std::uint32_t>(unsigned_member(transform, "texCoord", ref.uv_set));
    return ref;
}

/// The known textures of material extensions whose images can be decoded. Others are passed through
/// unchanged, like unknown extensions.
std::vector<ExtensionTexture> extension_textures(const LoadedGltf& loaded, const Json& material) {
    std::vector<ExtensionTexture> result;
    for (const KnownTexture& known : known_textures) {
        const std::string extension(known.extension), name(known.name);
        const Json& info = member(material, "extensions", extension.c_str(), name.c_str());
        const TextureRef texture = texture_ref(loaded, info);
        if (!texture || !can_decode_image(loaded.source->images[texture.image].mime_type)) continue;
        result.push_back({extension, name, texture, number_or(member(info, "scale"), 1)});
    }
    return result;
}

template <std::size_t N>
void read_factors(const Json& from, std::array<float, N>& to) {
    for (std::size_t i = 0; i < from.size(); ++i) to[i] = from[i].get<float>();
}

Material read_material(const LoadedGltf& loaded, const Json& json) {
    Material material;
    const Json& pbr = member(json, "pbrMetallicRoughness");
    const std::string alpha_mode = string_member(json, "alphaMode");
    material.name = string_member(json, "name");
    read_factors(member(pbr, "baseColorFactor"), material.base_color);
    read_factors(member(json, "emissiveFactor"), material.emissive);
    material.metallic = number_or(member(pbr, "metallicFactor"), 1);
    material.roughness = number_or(member(pbr, "roughnessFactor"), 1);
    for (const CoreSlot& slot : core_slots) {
        const Json& info = member(slot.is_in_pbr ? pbr : json, slot.key);
        material.*slot.texture = texture_ref(loaded, info);
        if (slot.factor) material.*slot.factor = number_or(member(info, slot.factor_key), 1);
    }
    material.extension_textures = extension_textures(loaded, json);
    if (alpha_mode == "MASK") material.alpha_mode = AlphaMode::mask;
    if (alpha_mode == "BLEND") material.alpha_mode = AlphaMode::blend;
    material.alpha_cutoff = number_or(member(json, "alphaCutoff"), 0.5f);
    material.double_sided = member(json, "doubleSided") == true;
    for (const auto& [name, value] : member(json, "extensions").items()) {
        if (name == "KHR_materials_unlit")
            material.unlit = true;
        else if (name != "KHR_texture_transform")
            material.extensions.push_back(name);
    }
    return material;
}

/// Resets numbers that are too large for a float to their defaults. Returns how many were reset.
std::uint64_t reset_non_finite_factors(Material& material) {
    const Material defaults;
    std::uint64_t count = 0;
    const auto reset = [&count](float& value, float fallback) {
        if (std::isfinite(value)) return;
        value = fallback;
        ++count;
    };
    for (std::size_t i = 0; i < 4; ++i) reset(material.base_color[i], defaults.base_color[i]);
    for (std::size_t i = 0; i < 3; ++i) reset(material.emissive[i], defaults.emissive[i]);
    reset(material.metallic, defaults.metallic);
    reset(material.roughness, defaults.roughness);
    for (const CoreSlot& slot : core_slots)
        if (slot.factor) reset(material.*slot.factor, 1);
    reset(material.alpha_cutoff, defaults.alpha_cutoff);
    for (ExtensionTexture& texture : material.extension_textures) reset(texture.normal_scale, 1);
    for_each_texture(material, [&](TextureRef& ref) {
        for (std::size_t i = 0; i < 2; ++i) reset(ref.offset[i], 0), reset(ref.scale[i], 1);
        reset(ref.rotation, 0);
    });
    return count;
}

}  // namespace

std::vector<Material> read_materials(LoadedGltf& loaded) {
    std::vector<Material> materials;
    for (const Json& json : member(loaded.source->document, "materials")) {
        Material material = read_material(loaded, json);
        material.source = static_cast<Index>(materials.size());
        if (const std::uint64_t count = reset_non_finite_factors(material); count != 0)
            loaded.warnings.push_back(child_path("/materials", materials.size()) + ": " +
                                      pluralized(count, "number") +
                                      " too large for a float, reset to the default");
        if (member(json, "extensions").contains("KHR_materials_pbrSpecularGlossiness"))
            loaded.warnings.push_back(
                child_path("/materials", materials.size()) +
                ": KHR_materials_pbrSpecularGlossiness is passed through, but not interpreted");
        materials.push_back(std::move(material));
    }
    return materials;
}

}  // namespace faqem::detail
