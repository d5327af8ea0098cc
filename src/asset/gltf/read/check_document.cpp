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

/// Other extensions that are read, or whose references are kept up to date.
constexpr std::array<std::string_view, 8> other_known_extensions = {draco_name,
                                                                    meshopt_name,
                                                                    "EXT_mesh_features",
                                                                    "EXT_structural_metadata",
                                                                    "CESIUM_primitive_outline",
                                                                    "EXT_mesh_manifold",
                                                                    "FB_ngon_encoding",
                                                                    "EXT_instance_features"};

template <class List>
bool contains(const List& list, std::string_view name) {
    return std::ranges::find(list, name) != list.end();
}

bool is_supported(std::string_view extension) {
    return contains(supported_extensions, extension) || extension.starts_with("KHR_materials_") ||
           extension == center_name || names_by_number(extension);
}

void check_version(const GltfChecker& checker) {
    const Json& asset = checker.object(checker.document, "", "asset");
    if (asset.is_null()) checker.fail("/asset", "is missing");
    const std::string version = string_member(asset, "version");
    if (!version.starts_with("2."))
        checker.fail_unsupported("/asset/version", "'" + version + "' is not supported, only 2.0 is");
    const std::string minimum = string_member(asset, "minVersion");
    if (!minimum.empty() && minimum != "2.0")
        checker.fail_unsupported("/asset/minVersion", "'" + minimum + "' is not supported, only 2.0 is");
}

void check_extension_list(const GltfChecker& checker, const char* key) {
    for (const Json& name : checker.array(checker.document, "", key))
        if (!name.is_string()) checker.fail(child_path("", key), "contains an element that is not a string");
}

void check_required_extensions(const GltfChecker& checker) {
    checker.for_each(checker.document, "", "extensionsRequired", [&](const Json& value, const auto& where) {
        const auto name = value.get<std::string>();
        if (name == draco_name || name == meshopt_name) {
            if (!has_codec(name)) checker.fail_unsupported(where, missing_decoder_message(name));
        } else if (!is_supported(name)) {
            checker.fail_unsupported(where, "the extension " + name + " is not supported");
        }
    });
}

/// Checks that every `extensions` outside of extras is an object of objects, which the writer relies on. The
/// recursion depth is limited by max_json_depth.
void check_extensions(const GltfChecker& checker, const Json& value, const std::string& where) {
    if (value.is_array())
        for (std::uint64_t i = 0; i < value.size(); ++i)
            check_extensions(checker, value[i], child_path(where, i));
    if (!value.is_object()) return;
    for (const auto& [name, extension] : checker.object(value, where, "extensions").items())
        if (!extension.is_object()) checker.fail(where + "/extensions/" + name, "is not an object");
    for (const auto& [key, child] : value.items())
        if (key != "extras") check_extensions(checker, child, child_path(where, key));
}

void check_image_lights(const GltfChecker& checker) {
    const std::string where = "/extensions/EXT_lights_image_based";
    const Json& extension = member(checker.document, "extensions", "EXT_lights_image_based");
    checker.for_each(extension, where, "lights", [&](const Json& light, const std::string& at) {
        for (const Json& mip : checker.array(light, at, "specularImages")) {
            if (!mip.is_array())
                checker.fail(at + "/specularImages", "contains an element that is not an array");
            for (const Json& image : mip) checker.checked_index(image, at + "/specularImages", "images");
        }
    });
}

}  // namespace

std::vector<std::string> unknown_extensions(const Json& document) {
    std::set<std::string> names;
    for_each_extension(document, [&](const std::string& name, const Json&) {
        if (!is_supported(name) && !contains(other_known_extensions, name)) names.insert(name);
    });
    return {names.begin(), names.end()};
}

void check_document(const GltfChecker& checker) {
    if (!checker.document.is_object()) checker.fail("", "is neither a GLB nor a JSON object");
    check_version(checker);
    check_extension_list(checker, "extensionsUsed");
    check_extension_list(checker, "extensionsRequired");
    check_required_extensions(checker);
    for (const char* key : top_level_arrays)
        checker.for_each(checker.document, "", key, [&](const Json& value, const std::string& where) {
            if (!value.is_object()) checker.fail(where, "is not an object");
        });
    check_extensions(checker, checker.document, "");
    check_image_lights(checker);
    const Json& tile = member(checker.document, "extensions", center_name);
    checker.check_number_array(tile, child_path("/extensions", center_name), "center", 3);
}

}  // namespace faqem::detail
