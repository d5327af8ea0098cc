#include <algorithm>
#include <initializer_list>
#include <string_view>
#include <utility>

#include "asset/gltf/write/writer.hpp"
#include "asset/known_textures.hpp"

namespace faqem::detail {
namespace {

template <std::size_t N>
Json factors(const std::array<float, N>& values) {
    Json array = Json::array();
    for (const float value : values) array.push_back(shortest(value));
    return array;
}

/// Writes a member only where it changed, so that untouched numbers keep their digits.
template <class T>
void set_changed(Json& object, const char* key, const T& now, const T& was, const T& standard,
                 const Json& value) {
    if (now == was) return;
    if (now == standard)
        object.erase(key);
    else
        object[key] = value;
}

bool same_use(const GltfWriter& writer, const TextureRef& now, const TextureRef& was) {
    if (!now || !was) return false;
    TextureRef in_source = now;
    in_source.image = writer.source_image_of[now.image];
    return in_source == was;
}

Json fresh_texture_info(GltfWriter& writer, const TextureRef& ref) {
    Json info = {{"index", make_texture(writer, ref)}};
    if (ref.uv_set != 0) info["texCoord"] = ref.uv_set;
    Json transform = Json::object();
    if (ref.offset != Vec2f{0, 0}) transform["offset"] = factors(ref.offset);
    if (ref.scale != Vec2f{1, 1}) transform["scale"] = factors(ref.scale);
    if (ref.rotation != 0) transform["rotation"] = shortest(ref.rotation);
    if (!transform.empty()) info["extensions"]["KHR_texture_transform"] = std::move(transform);
    return info;
}

/// Puts the texture info under `key` right: kept where nothing changed, made anew or erased otherwise.
void write_slot(GltfWriter& writer, Json& holder, const char* key, const TextureRef& now,
                const TextureRef& was) {
    if (!now) {
        holder.erase(key);
    } else if (same_use(writer, now, was)) {
        holder[key]["index"] = copy_texture(writer, index_of(holder[key], "index"));
    } else {
        holder[key] = fresh_texture_info(writer, now);
    }
}

/// normalTexture.scale or occlusionTexture.strength.
void write_slot_number(Json& holder, const char* key, const char* number, float now, float was) {
    const auto slot = holder.find(key);
    if (slot == holder.end() || (now == was && slot->contains(number))) return;
    if (now == 1)
        slot->erase(number);
    else
        (*slot)[number] = shortest(now);
}

void write_metallic_roughness(GltfWriter& writer, Json& json, const Material& now, const Material& was) {
    Json& pbr = json["pbrMetallicRoughness"];
    if (pbr.is_null()) pbr = Json::object();
    set_changed(pbr, "baseColorFactor", now.base_color, was.base_color, Vec4f{1, 1, 1, 1},
                factors(now.base_color));
    set_changed(pbr, "metallicFactor", now.metallic, was.metallic, 1.0f, shortest(now.metallic));
    set_changed(pbr, "roughnessFactor", now.roughness, was.roughness, 1.0f, shortest(now.roughness));
    write_slot(writer, pbr, "baseColorTexture", now.base_color_texture, was.base_color_texture);
    write_slot(writer, pbr, "metallicRoughnessTexture", now.metallic_roughness_texture,
               was.metallic_roughness_texture);
    if (pbr.empty()) json.erase("pbrMetallicRoughness");
}

void write_alpha(Json& json, const Material& now, const Material& was) {
    const char* mode = now.alpha_mode == AlphaMode::mask ? "MASK" : "BLEND";
    set_changed(json, "alphaMode", now.alpha_mode, was.alpha_mode, AlphaMode::opaque, mode);
    // Only valid with the mode MASK.
    if (now.alpha_mode != AlphaMode::mask)
        json.erase("alphaCutoff");
    else
        set_changed(json, "alphaCutoff", now.alpha_cutoff, was.alpha_cutoff, 0.5f,
                    shortest(now.alpha_cutoff));
}

/// Texture infos in `holder`, but for those that are `known`: followed, or removed where the UVs are new.
/// \return the names of those that were removed
std::vector<std::string> write_other_textures(GltfWriter& writer, const Material& material, Json& holder,
                                              std::initializer_list<std::string_view> known = {}) {
    std::vector<std::string> infos;
    for (const auto& [key, value] : holder.items()) {
        if (is_texture_info(key, value) && std::find(known.begin(), known.end(), key) == known.end())
            infos.push_back(key);
    }
    for (const std::string& key : infos) {
        if (material.rebaked)
            holder.erase(key);
        else
            holder[key]["index"] = copy_texture(writer, index_of(holder[key], "index"));
    }
    return material.rebaked ? infos : std::vector<std::string>();
}

/// \param part  of it that is meant: `textures`
void warn_of_removed(GltfWriter& writer, const Material& material, const std::string& what,
                     const std::string& part) {
    writer.warnings.push_back("material '" + material.name + "': the " + part + " of " + what +
                              " do not fit the new texture coordinates and were left out");
}

const ExtensionTexture* find_texture(const Material& material, const std::string& extension,
                                     const std::string& name) {
    for (const ExtensionTexture& texture : material.extension_textures)
        if (texture.extension == extension && texture.name == name) return &texture;
    return nullptr;
}

/// Texture infos of the source's extension that the material does not have any more: erased. What was there in
/// places must not be everywhere, so the factor of such a texture goes too. \return how many
std::size_t erase_textures(const Material& now, const Material& was, const std::string& name,
                           Json& extension) {
    std::vector<std::string> gone;
    for (const auto& [key, value] : extension.items()) {
        if (!is_texture_info(key, value) || find_texture(now, name, key)) continue;
        if (now.rebaked || find_texture(was, name, key)) gone.push_back(key);
    }
    for (const std::string& key : gone) {
        extension.erase(key);
        const KnownTexture* known = find_known_texture(name, key);
        if (known && !known->switch_factor.empty()) extension.erase(std::string(known->switch_factor));
    }
    return gone.size();
}

/// The textures of the source's extension that are not the material's are followed.
void follow_textures(GltfWriter& writer, const Material& now, const std::string& name, Json& extension) {
    for (auto& [key, value] : extension.items()) {
        if (is_texture_info(key, value) && !find_texture(now, name, key))
            value["index"] = copy_texture(writer, index_of(value, "index"));
    }
}

/// Its directions are those of the texture coordinates, with or without a texture.
constexpr const char* anisotropy = "KHR_materials_anisotropy";

void write_extensions(GltfWriter& writer, const Material& now, const Material& was, Json& json) {
    static const ExtensionTexture none;
    if (now.rebaked && json.contains("extensions") && json["extensions"].erase(anisotropy) != 0)
        warn_of_removed(writer, now, anisotropy, "directions");
    if (json.contains("extensions")) {
        for (auto& [name, extension] : json["extensions"].items()) {
            if (erase_textures(now, was, name, extension) != 0)
                warn_of_removed(writer, now, name, "textures");
            follow_textures(writer, now, name, extension);
        }
    }
    for (const ExtensionTexture& texture : now.extension_textures) {
        const ExtensionTexture* before = find_texture(was, texture.extension, texture.name);
        Json& extension = json["extensions"][texture.extension];
        const ExtensionTexture& old = before ? *before : none;
        write_slot(writer, extension, texture.name.c_str(), texture.texture, old.texture);
        write_slot_number(extension, texture.name.c_str(), "scale", texture.normal_scale, old.normal_scale);
    }
}

/// Textures of members that glTF does not have.
void write_foreign_textures(GltfWriter& writer, const Material& material, Json& json) {
    std::vector<std::string> removed = write_other_textures(
        writer, material, json, {"normalTexture", "occlusionTexture", "emissiveTexture"});
    if (json.contains("pbrMetallicRoughness")) {
        const std::vector<std::string> more = write_other_textures(
            writer, material, json["pbrMetallicRoughness"], {"baseColorTexture", "metallicRoughnessTexture"});
        removed.insert(removed.end(), more.begin(), more.end());
    }
    for (const std::string& name : removed) warn_of_removed(writer, material, name, "textures");
}

void write_unlit(Json& json, bool unlit) {
    if (unlit)
        json["extensions"]["KHR_materials_unlit"] = Json::object();
    else if (json.contains("extensions"))
        json["extensions"].erase("KHR_materials_unlit");
    if (json.contains("extensions") && json["extensions"].empty()) json.erase("extensions");
}

Json material_json(GltfWriter& writer, const Material& material) {
    const bool has_source = material.source < writer.source.materials.size();
    static const Material standard;
    const Material& was = has_source ? writer.source.materials[material.source] : standard;
    Json json = has_source ? source_array(writer, "materials")[material.source] : Json::object();

    if (material.name != was.name) json["name"] = material.name;
    write_metallic_roughness(writer, json, material, was);
    write_slot(writer, json, "normalTexture", material.normal_texture, was.normal_texture);
    write_slot_number(json, "normalTexture", "scale", material.normal_scale, was.normal_scale);
    write_slot(writer, json, "occlusionTexture", material.occlusion_texture, was.occlusion_texture);
    write_slot_number(json, "occlusionTexture", "strength", material.occlusion_strength,
                      was.occlusion_strength);
    write_slot(writer, json, "emissiveTexture", material.emissive_texture, was.emissive_texture);
    set_changed(json, "emissiveFactor", material.emissive, was.emissive, Vec3f{0, 0, 0},
                factors(material.emissive));
    write_alpha(json, material, was);
    set_changed(json, "doubleSided", material.double_sided, was.double_sided, false, material.double_sided);
    write_foreign_textures(writer, material, json);
    write_extensions(writer, material, was, json);
    write_unlit(json, material.unlit);
    return json;
}

}  // namespace

Index write_material(GltfWriter& writer, Index material) {
    const auto [entry, is_new] = writer.asset_materials.try_emplace(material, no_index);
    if (is_new)
        entry->second = append(writer, "materials", material_json(writer, writer.asset.materials[material]));
    return entry->second;
}

Index write_source_material(GltfWriter& writer, Index material) {
    const std::vector<Material>& materials = writer.asset.materials;
    for (Index i = 0; i < materials.size(); ++i)
        if (materials[i].source == material && !materials[i].rebaked) return write_material(writer, i);
    const auto [entry, is_new] = writer.source_materials.try_emplace(material, no_index);
    if (!is_new) return entry->second;

    Json json = source_array(writer, "materials")[material];
    for (Json* holder :
         {&json, json.contains("pbrMetallicRoughness") ? &json["pbrMetallicRoughness"] : &json})
        for (auto& [key, value] : holder->items())
            if (is_texture_info(key, value)) value["index"] = copy_texture(writer, index_of(value, "index"));
    if (json.contains("extensions")) {
        for (auto& [name, extension] : json["extensions"].items())
            follow_textures(writer, {}, name, extension);
    }
    entry->second = append(writer, "materials", std::move(json));
    return entry->second;
}

}  // namespace faqem::detail
