#include <algorithm>
#include <array>
#include <set>
#include <string_view>

#include "asset/gltf/read/checker.hpp"
#include "asset/gltf/read/compressed.hpp"
#include "asset/gltf/scene.hpp"
#include "asset/gltf/source_document.hpp"

namespace faqem::detail {
namespace {

constexpr std::array top_level_arrays = {"accessors", "animations", "buffers", "bufferViews", "cameras",
                                         "images",    "materials",  "meshes",  "nodes",       "samplers",
                                         "scenes",    "skins",      "textures"};

/// Required extensions that are read, or that are passed through and do not affect meshes and materials.
constexpr std::array<std::string_view, 13> supported_extensions = {
    "KHR_mesh_quantization", "KHR_texture_transform", "KHR_lights_punctual",    "KHR_xmp_json_ld",
    "KHR_animation_pointer", "KHR_node_visibility",   "EXT_lights_image_based", "EXT_texture_webp",
    "KHR_texture_basisu",    "EXT_texture_avif",      "MSFT_texture_dds",       lod_name,
    instancing_name};

template <class List>
bool contains(const List& list, std::string_view name) {
    return std::ranges::find(list, name) != list.end();
}

bool is_supported(std::string_view extension) {
    return contains(supported_extensions, extension) || extension.starts_with("KHR_materials_") ||
           extension == center_name || names_by_number(extension);
}

/// Whether an extension is read, or its references are kept up to date.
bool is_known(std::string_view extension) {
    return is_supported(extension) || contains(vertex_extensions, extension) || extension == meshopt_name ||
           extension == "EXT_instance_features";
}

void check_version(const CheckedJson& document) {
    const CheckedJson asset = document.object("asset");
    if (asset.json.is_null()) asset.fail("is missing");
    const std::string version = string_member(asset.json, "version");
    if (!version.starts_with("2."))
        asset.member("version").fail_unsupported("'" + version + "' is not supported, only 2.0 is");
    const std::string minimum = string_member(asset.json, "minVersion");
    if (!minimum.empty() && minimum != "2.0")
        asset.member("minVersion").fail_unsupported("'" + minimum + "' is not supported, only 2.0 is");
}

void check_extension_list(const CheckedJson& document, const char* key) {
    const CheckedJson names = document.array(key);
    for (const Json& name : names.json)
        if (!name.is_string()) names.fail("contains an element that is not a string");
}

void check_required_extension(const CheckedJson& extension) {
    const auto name = extension.json.get<std::string>();
    if (name == draco_name || name == meshopt_name) {
        if (!has_codec(name)) extension.fail_unsupported(missing_decoder_message(name));
    } else if (!is_supported(name)) {
        extension.fail_unsupported("the extension " + name + " is not supported");
    }
}

/// Checks that every `extensions` outside of extras is an object of objects, which the writer relies on. The
/// recursion depth is limited by max_json_depth.
void check_extensions(const CheckedJson& value) {
    if (value.json.is_array()) value.elements(check_extensions);
    if (!value.json.is_object()) return;
    value.object("extensions").members([](const std::string&, const CheckedJson& extension) {
        if (!extension.json.is_object()) extension.fail("is not an object");
    });
    value.members([](const std::string& key, const CheckedJson& child) {
        if (key != "extras") check_extensions(child);
    });
}

void check_image_light(const CheckedJson& light) {
    light.for_each("specularImages", [](const CheckedJson& mip) {
        if (!mip.json.is_array()) mip.fail("is not an array");
        mip.elements([](const CheckedJson& image) { image.index("images"); });
    });
}

}  // namespace

std::vector<std::string> unknown_extensions(const Json& document) {
    std::set<std::string> names;
    for_each_extension(document, [&](const std::string& name, const Json&) {
        if (!is_known(name)) names.insert(name);
    });
    return {names.begin(), names.end()};
}

void check_document(const CheckedJson& document) {
    if (!document.json.is_object()) document.fail("is neither a GLB nor a JSON object");
    check_version(document);
    check_extension_list(document, "extensionsUsed");
    check_extension_list(document, "extensionsRequired");
    document.for_each("extensionsRequired", check_required_extension);
    for (const char* key : top_level_arrays)
        document.for_each(key, [](const CheckedJson& value) {
            if (!value.json.is_object()) value.fail("is not an object");
        });
    check_extensions(document);
    const CheckedJson extensions = document.member("extensions");
    extensions.member("EXT_lights_image_based").for_each("lights", check_image_light);
    extensions.member(center_name).check_number_array("center", 3);
}

}  // namespace faqem::detail
