#include <algorithm>
#include <charconv>
#include <set>
#include <string_view>
#include <utility>

#include "asset/gltf/scene.hpp"
#include "asset/gltf/write/writer.hpp"

namespace faqem::detail {
namespace {

/// Extensions whose references are remapped, or that have no references.
constexpr std::array<std::string_view, 11> remapped_extensions = {
    instancing_name, "EXT_lights_image_based", "EXT_texture_webp", "EXT_lights_ies", "MSFT_texture_dds",
    "MSFT_lod",      "EXT_instance_features",  features_name,      metadata_name,    manifold_name,
    outline_name};

bool is_skinned(const Json& mesh) {
    return std::ranges::any_of(member(mesh, "primitives"), [](const Json& primitive) {
        return member(primitive, "attributes").contains("JOINTS_0");
    });
}

void update_node(GltfWriter& writer, Json& node) {
    const Index source_mesh = index_member(node, "mesh");
    // The instances of a node without a mesh are removed, so that their accessors are not written.
    if (source_mesh == no_index || writer.mesh_map[source_mesh] == no_index)
        erase_extension(node, instancing_name);
    if (!any_needs_transform(writer) && member(node, "extensions", instancing_name).contains("attributes"))
        for (Json& accessor : node["extensions"][instancing_name]["attributes"])
            accessor = copy_accessor(writer, accessor.get<Index>(), AccessorUse::other);
    if (source_mesh == no_index) return;
    const Index mesh = writer.mesh_map[source_mesh];
    if (mesh == no_index) {
        for (const char* key : {"mesh", "skin", "weights"}) node.erase(key);
        return;
    }
    node["mesh"] = mesh;
    if (node.contains("skin") && is_skinned(source_array(writer, "meshes")[source_mesh]) &&
        !is_skinned(member(writer.out, "meshes")[mesh])) {
        node.erase("skin");
        writer.warnings.push_back("node '" + string_member(node, "name") +
                                  "': its mesh no longer has joints; the skin was left out");
    }
    if (node.contains("weights") && array_size(node, "weights") != morph_target_count(writer, mesh))
        node.erase("weights");
}

void add_nodes(GltfWriter& writer, const std::vector<Index>& new_meshes) {
    Json roots = Json::array();
    for (const Index mesh : new_meshes) {
        if (mesh == no_index) continue;
        Json node = {{"mesh", mesh}};
        if (writer.origin != Vec3{}) node["translation"] = writer.origin;
        const Json& name = member(writer.out["meshes"][mesh], "name");
        if (!name.is_null()) node["name"] = name;
        roots.push_back(append(writer, "nodes", std::move(node)));
    }
    if (roots.empty()) return;
    if (array_size(writer.out, "scenes") == 0) {
        writer.out["scene"] = 0;
        writer.out["scenes"] = Json::array({{{"nodes", roots}}});
        return;
    }
    Json& nodes = writer.out["scenes"][unsigned_member(writer.out, "scene", 0)]["nodes"];
    for (const Json& root : roots) nodes.push_back(root);
}

/// Replaces the index in a JSON pointer such as /materials/3/emissiveFactor. Returns false if the object was
/// not written.
bool remap_pointer(GltfWriter& writer, std::string& pointer) {
    const bool is_material = pointer.starts_with("/materials/");
    const bool is_mesh = pointer.starts_with("/meshes/");
    if (!is_material && !is_mesh) return true;
    const std::size_t begin = is_material ? 11 : 8;
    const std::size_t end = std::min(pointer.find('/', begin), pointer.size());
    Index index = no_index;
    std::from_chars(pointer.data() + begin, pointer.data() + end, index);
    Index new_index = no_index;
    if (is_mesh) {
        if (index < writer.mesh_map.size()) new_index = writer.mesh_map[index];
    } else {
        for (const auto& [material, written] : writer.asset_materials)
            if (writer.asset.materials[material].source == index && !writer.asset.materials[material].rebaked)
                new_index = written;
        const auto copied = writer.source_materials.find(index);
        if (copied != writer.source_materials.end()) new_index = copied->second;
    }
    if (new_index == no_index) return false;
    pointer.replace(begin, end - begin, std::to_string(new_index));
    return true;
}

bool update_channel(GltfWriter& writer, Json& channel) {
    Json& target = channel["target"];
    const Index node = index_member(target, "node");
    if (string_member(target, "path") == "weights" && node != no_index &&
        morph_target_count(writer, index_member(writer.out["nodes"][node], "mesh")) == 0)
        return false;
    const Json& pointer = member(target, "extensions", "KHR_animation_pointer");
    if (!pointer.contains("pointer")) return true;
    std::string text = string_member(pointer, "pointer");
    const bool is_remapped = remap_pointer(writer, text);
    target["extensions"]["KHR_animation_pointer"]["pointer"] = text;
    return is_remapped;
}

void update_animations(GltfWriter& writer) {
    filter_channels(writer.out, [&](const Json& animation, Json& channel) {
        const bool is_kept = update_channel(writer, channel);
        if (!is_kept)
            writer.warnings.push_back("animation '" + string_member(animation, "name") +
                                      "': a channel was left out because its target was removed");
        return is_kept;
    });
    for (Json& animation : elements(writer.out, "animations"))
        for (Json& sampler : animation["samplers"])
            for (const char* key : {"input", "output"})
                sampler[key] = copy_accessor(writer, index_member(sampler, key), AccessorUse::other);
}

void remap_image_lights(GltfWriter& writer) {
    const char* name = "EXT_lights_image_based";
    if (!member(writer.out, "extensions", name).contains("lights")) return;
    for (Json& light : writer.out["extensions"][name]["lights"])
        for (Json& mip : elements(light, "specularImages"))
            for (Json& image : mip) image = copy_image(writer, image.get<Index>());
}

bool contains_number(const Json& value) {
    if (value.is_number_unsigned()) return true;
    return value.is_structured() && std::ranges::any_of(value, contains_number);
}

/// Whether what an extension names by number has the number of the source: meshes whose faces are gone and images that
/// are missing leave gaps.
bool keeps_numbers(const GltfWriter& writer) {
    for (Index mesh = 0; mesh < writer.mesh_map.size(); ++mesh)
        if (writer.mesh_map[mesh] != mesh) return false;
    return std::ranges::none_of(writer.source.images,
                                [](const Image& image) { return image.encoded.empty(); });
}

void warn_about_unknown_extensions(GltfWriter& writer) {
    std::set<std::string> unknown;
    for_each_extension(writer.out, [&](const std::string& name, const Json& value) {
        if (!name.starts_with("KHR_") && name != center_name &&
            !(names_by_number(name) && keeps_numbers(writer)) &&
            std::ranges::find(remapped_extensions, name) == remapped_extensions.end() &&
            contains_number(value))
            unknown.insert(name);
    });
    for (const std::string& name : unknown)
        writer.warnings.push_back("the extension " + name +
                                  " is unknown and was passed through; indices of meshes, materials, "
                                  "textures or accessors in it may be wrong");
}

}  // namespace

Index morph_target_count(const GltfWriter& writer, Index mesh) {
    if (mesh == no_index) return 0;
    Index targets = 0;
    for (const Json& primitive : member(writer.out, "meshes")[mesh]["primitives"])
        targets = std::max(targets, static_cast<Index>(array_size(primitive, "targets")));
    return targets;
}

void write_scene(GltfWriter& writer, const std::vector<Index>& new_meshes) {
    for (Json& node : elements(writer.out, "nodes")) update_node(writer, node);
    add_nodes(writer, new_meshes);
    if (!any_needs_transform(writer))
        for (Json& skin : elements(writer.out, "skins"))
            if (skin.contains("inverseBindMatrices"))
                skin["inverseBindMatrices"] =
                    copy_accessor(writer, index_member(skin, "inverseBindMatrices"), AccessorUse::matrices);
    update_animations(writer);
    remap_image_lights(writer);
    warn_about_unknown_extensions(writer);
}

void write_extension_lists(GltfWriter& writer) {
    // The list of variants is removed if no primitive has variants.
    bool has_variants = false;
    for_each_extension(member(writer.out, "meshes"), [&](const std::string& name, const Json&) {
        has_variants = has_variants || name == variants_name;
    });
    if (!has_variants) erase_extension(writer.out, variants_name);
    std::set<std::string> used;
    for_each_extension(writer.out, [&](const std::string& name, const Json&) { used.insert(name); });
    Json required = Json::array();
    const char* quantization_name = "KHR_mesh_quantization";
    if (writer.needs_quantization) {
        used.insert(quantization_name);
        required.push_back(quantization_name);
    }
    if (used.count(draco_name) != 0) required.push_back(draco_name);
    for (const Json& name : source_array(writer, "extensionsRequired"))
        if (name != draco_name && name != quantization_name && used.count(name.get<std::string>()) != 0)
            required.push_back(name);
    set_or_erase(writer.out, "extensionsUsed", Json(used));
    set_or_erase(writer.out, "extensionsRequired", std::move(required));
}

}  // namespace faqem::detail
