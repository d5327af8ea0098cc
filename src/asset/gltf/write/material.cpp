#include <utility>

#include "asset/gltf/source_document.hpp"
#include "asset/gltf/write/writer.hpp"
#include "asset/scene/material_textures.hpp"

namespace faqem::detail {
namespace {

constexpr const char* pbr_key = "pbrMetallicRoughness";

Json json_of(bool value) { return value; }
Json json_of(float value) { return shortest_decimal(value); }
Json json_of(AlphaMode mode) { return mode == AlphaMode::mask ? "MASK" : "BLEND"; }

template <std::size_t N>
Json json_of(const std::array<float, N>& values) {
    Json array = Json::array();
    for (const float value : values) array.push_back(shortest_decimal(value));
    return array;
}

/// Writes a member only if it changed, so that unmodified numbers keep their digits. Erases default values.
template <class T>
void set_if_changed(Json& object, const char* key, const T& current, const T& original,
                    const T& default_value) {
    if (current == original) return;
    if (current == default_value)
        object.erase(key);
    else
        object[key] = json_of(current);
}

bool is_same_reference(const GltfWriter& writer, const TextureRef& current, const TextureRef& original) {
    if (!current || !original) return false;
    TextureRef in_source = current;
    in_source.image = writer.source_image_of[current.image];
    return in_source == original;
}

Json make_texture_info(GltfWriter& writer, const TextureRef& ref) {
    Json info = {{"index", make_texture(writer, ref)}};
    if (ref.uv_set != 0) info["texCoord"] = ref.uv_set;
    Json transform = Json::object();
    if (ref.offset != Vec2f{0, 0}) transform["offset"] = json_of(ref.offset);
    if (ref.scale != Vec2f{1, 1}) transform["scale"] = json_of(ref.scale);
    if (ref.rotation != 0) transform["rotation"] = shortest_decimal(ref.rotation);
    if (!transform.empty()) info["extensions"]["KHR_texture_transform"] = std::move(transform);
    return info;
}

/// Whether only the image of a reference differs from the source.
bool has_other_image_only(const TextureRef& current, const TextureRef& original) {
    TextureRef with_image = current;
    with_image.image = original.image;
    return original && with_image == original;
}

/// Updates the texture info under `key`: kept with a new index if at most the image changed, rebuilt if the
/// reference did, erased if it is unset. An animation may point to a transform that does nothing at rest.
/// \param material  whose texture it is
void write_texture_info(GltfWriter& writer, const Material& material, Json& holder, const char* key,
                        const TextureRef& current, const TextureRef& original) {
    if (!current) {
        holder.erase(key);
    } else if (is_same_reference(writer, current, original)) {
        holder[key]["index"] = copy_texture(writer, index_member(holder[key], "index"));
    } else if (has_other_image_only(current, original)) {
        // The image of a new page has nothing to do with the sampler of the source.
        holder[key]["index"] = material.rebaked
                                   ? make_texture(writer, current)
                                   : copy_texture(writer, index_member(holder[key], "index"), current.image);
    } else {
        holder[key] = make_texture_info(writer, current);
    }
}

/// Updates the factor of a texture info: `scale` of a normal texture or `strength` of an occlusion texture.
void write_texture_factor(Json& holder, const char* key, const char* number, float current, float original) {
    const auto slot = holder.find(key);
    if (slot == holder.end() || (current == original && slot->contains(number))) return;
    if (current == 1)
        slot->erase(number);
    else
        (*slot)[number] = shortest_decimal(current);
}

void write_core_textures(GltfWriter& writer, Json& json, const Material& current, const Material& original) {
    Json& pbr = json[pbr_key];
    if (pbr.is_null()) pbr = Json::object();
    set_if_changed(pbr, "baseColorFactor", current.base_color, original.base_color, Vec4f{1, 1, 1, 1});
    set_if_changed(pbr, "metallicFactor", current.metallic, original.metallic, 1.0f);
    set_if_changed(pbr, "roughnessFactor", current.roughness, original.roughness, 1.0f);
    for (const CoreSlot& slot : core_slots) {
        Json& holder = slot.is_in_pbr ? pbr : json;
        write_texture_info(writer, current, holder, slot.key, current.*slot.texture, original.*slot.texture);
        if (slot.factor)
            write_texture_factor(holder, slot.key, slot.factor_key, current.*slot.factor,
                                 original.*slot.factor);
    }
    if (pbr.empty()) json.erase(pbr_key);
}

void write_alpha(Json& json, const Material& current, const Material& original) {
    set_if_changed(json, "alphaMode", current.alpha_mode, original.alpha_mode, AlphaMode::opaque);
    // alphaCutoff is valid only with the mode MASK.
    if (current.alpha_mode != AlphaMode::mask)
        json.erase("alphaCutoff");
    else
        set_if_changed(json, "alphaCutoff", current.alpha_cutoff, original.alpha_cutoff, 0.5f);
}

/// Adds a warning that `part` (for example "textures") of `what` was removed because the UVs are new.
void warn_about_removed(GltfWriter& writer, const Material& material, const std::string& what,
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

/// Whether a texture info under `key` is written from the Material.
/// \param holder  extension that has it, or pbr_key, or empty for the material itself
bool is_known(const Material& material, const std::string& holder, const std::string& key) {
    const CoreSlot* slot = find_core_slot(key);
    return find_texture(material, holder, key) || (slot && holder == (slot->is_in_pbr ? pbr_key : ""));
}

/// Erases the texture infos of the source that do not fit new UVs, and those of extensions that the material no longer
/// has, with the factors that enable their effect: without the texture, the effect would apply to the whole surface.
/// \return the names of the erased texture infos
std::vector<std::string> erase_textures(const Material& current, const Material& original,
                                        const std::string& holder, Json& object) {
    std::vector<std::string> removed;
    for (const auto& [key, value] : object.items()) {
        if (!is_texture_info(key, value) || is_known(current, holder, key)) continue;
        if (current.rebaked || find_texture(original, holder, key)) removed.push_back(key);
    }
    for (const std::string& key : removed) {
        object.erase(key);
        const KnownTexture* known = find_known_texture(holder, key);
        if (known && !known->enabling_factor.empty()) object.erase(std::string(known->enabling_factor));
    }
    return removed;
}

/// Copies the remaining textures of the source that are not written from the Material.
/// \param current  null: none of them is
void remap_textures(GltfWriter& writer, const Material* current, const std::string& holder, Json& object) {
    for (auto& [key, value] : object.items())
        if (is_texture_info(key, value) && !(current && is_known(*current, holder, key)))
            value["index"] = copy_texture(writer, index_member(value, "index"));
}

/// The directions of this extension are relative to the texture coordinates, even without a texture.
constexpr const char* anisotropy = "KHR_materials_anisotropy";

void write_extensions(GltfWriter& writer, const Material& current, const Material& original, Json& json) {
    static const ExtensionTexture none;
    if (current.rebaked && erase_extension(json, anisotropy))
        warn_about_removed(writer, current, anisotropy, "directions");
    if (json.contains("extensions")) {
        for (auto& [name, extension] : json["extensions"].items()) {
            if (!erase_textures(current, original, name, extension).empty())
                warn_about_removed(writer, current, name, "textures");
            remap_textures(writer, &current, name, extension);
        }
    }
    for (const ExtensionTexture& texture : current.extension_textures) {
        const ExtensionTexture* previous = find_texture(original, texture.extension, texture.name);
        if (!previous) previous = &none;
        Json& extension = json["extensions"][texture.extension];
        write_texture_info(writer, current, extension, texture.name.c_str(), texture.texture,
                           previous->texture);
        write_texture_factor(extension, texture.name.c_str(), "scale", texture.normal_scale,
                             previous->normal_scale);
    }
}

/// Updates the textures of members that are not part of glTF.
void write_unknown_textures(GltfWriter& writer, const Material& current, const Material& original,
                            Json& json) {
    for (const std::string holder : {"", pbr_key}) {
        if (!holder.empty() && !json.contains(holder)) continue;
        Json& object = holder.empty() ? json : json[holder];
        for (const std::string& name : erase_textures(current, original, holder, object))
            warn_about_removed(writer, current, name, "textures");
        remap_textures(writer, &current, holder, object);
    }
}

void write_unlit(Json& json, bool unlit) {
    if (unlit)
        json["extensions"]["KHR_materials_unlit"] = Json::object();
    else
        erase_extension(json, "KHR_materials_unlit");
    if (json.contains("extensions") && json["extensions"].empty()) json.erase("extensions");
}

/// Writes the coarser levels of a material, too. One that is being written already refers back to itself: it is left
/// out.
void write_levels_of_material(GltfWriter& writer, Json& json) {
    if (level_ids(json).is_null()) return;
    Json ids = Json::array();
    for (const Json& id : level_ids(json)) {
        const Index level = write_source_material(writer, id.get<Index>());
        if (level != no_index) ids.push_back(level);
    }
    json["extensions"][lod_name]["ids"] = std::move(ids);
}

Json material_json(GltfWriter& writer, const Material& material) {
    const bool has_source = material.source < writer.source.materials.size();
    static const Material default_value;
    const Material& original = has_source ? writer.source.materials[material.source] : default_value;
    Json json = has_source ? source_array(writer, "materials")[material.source] : Json::object();

    if (material.name != original.name) json["name"] = material.name;
    write_core_textures(writer, json, material, original);
    set_if_changed(json, "emissiveFactor", material.emissive, original.emissive, Vec3f{0, 0, 0});
    write_alpha(json, material, original);
    set_if_changed(json, "doubleSided", material.double_sided, original.double_sided, false);
    write_unknown_textures(writer, material, original, json);
    write_extensions(writer, material, original, json);
    write_unlit(json, material.unlit);
    write_levels_of_material(writer, json);
    return json;
}

}  // namespace

Index write_material(GltfWriter& writer, Index material) {
    return once(writer.asset_materials, material, [&] {
        return append(writer, "materials",
                      material_json(writer, material_or_default(writer.asset, material)));
    });
}

Index write_source_material(GltfWriter& writer, Index material) {
    const std::vector<Material>& materials = writer.asset.materials;
    for (Index i = 0; i < materials.size(); ++i)
        if (materials[i].source == material && !materials[i].rebaked) return write_material(writer, i);
    return once(writer.source_materials, material, [&] {
        Json json = source_array(writer, "materials")[material];
        remap_textures(writer, nullptr, "", json);
        if (json.contains(pbr_key)) remap_textures(writer, nullptr, pbr_key, json[pbr_key]);
        if (json.contains("extensions"))
            for (auto& [name, extension] : json["extensions"].items())
                remap_textures(writer, nullptr, name, extension);
        write_levels_of_material(writer, json);
        return append(writer, "materials", std::move(json));
    });
}

void write_numbered_objects(GltfWriter& writer) {
    if (!names_objects_by_number(writer.source.document)) return;
    writer.replaced_images.assign(writer.source.images.size(), no_index);
    const auto replace = [&](const TextureRef& current, const TextureRef& original) {
        if (!current || !has_other_image_only(current, original)) return;
        Index& replaced = writer.replaced_images[original.image];
        if (replaced == no_index && writer.source_image_of[current.image] == no_index)
            replaced = current.image;
    };
    for (const Material& material : writer.asset.materials) {
        if (material.rebaked || material.source >= writer.source.materials.size()) continue;
        const Material& original = writer.source.materials[material.source];
        for (const CoreSlot& slot : core_slots) replace(material.*slot.texture, original.*slot.texture);
        for (const ExtensionTexture& own : material.extension_textures)
            if (const ExtensionTexture* previous = find_texture(original, own.extension, own.name))
                replace(own.texture, previous->texture);
    }
    for (Index i = 0; i < writer.source.images.size(); ++i)
        if (!writer.source.images[i].encoded.empty()) copy_image(writer, i);
    for (Index i = 0; i < source_array(writer, "textures").size(); ++i) copy_texture(writer, i);
    for (Index i = 0; i < source_array(writer, "materials").size(); ++i) write_source_material(writer, i);
}

}  // namespace faqem::detail
