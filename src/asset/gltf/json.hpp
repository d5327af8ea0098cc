#pragma once
/// \file
/// JSON helpers of the glTF reader and writer. The document is kept as JSON, because unmodified members must be
/// preserved.

#include <array>
#include <cstdint>
#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "faqem/mesh.hpp"

namespace faqem::detail {

using Json = nlohmann::json;

/// Maximum nesting depth of arrays and objects, which limits recursion.
inline constexpr int max_json_depth = 64;

/// Names of the extensions that compress geometry.
inline constexpr const char* meshopt_name = "EXT_meshopt_compression";
inline constexpr const char* draco_name = "KHR_draco_mesh_compression";

/// Whether faqem was built with the library for one of these.
bool has_codec(std::string_view extension);

/// Name of the extension that gives a node or a material coarser levels of detail, and of the extras beside it.
inline constexpr const char* lod_name = "MSFT_lod";
inline constexpr const char* coverage_name = "MSFT_screencoverage";

/// Name of the extension with the center of a tile of 3D Tiles.
inline constexpr const char* center_name = "CESIUM_RTC";

inline constexpr const char* variants_name = "KHR_materials_variants";
inline constexpr const char* features_name = "EXT_mesh_features";
inline constexpr const char* metadata_name = "EXT_structural_metadata";
inline constexpr const char* outline_name = "CESIUM_primitive_outline";
inline constexpr const char* manifold_name = "EXT_mesh_manifold";
inline constexpr const char* ngon_name = "FB_ngon_encoding";

/// Extensions of primitives and meshes that describe the source vertices or triangles, which may no longer exist.
inline constexpr std::array vertex_extensions = {draco_name,   features_name, metadata_name,
                                                 outline_name, manifold_name, ngon_name};

/// Extensions of textures whose images have other media types than PNG and JPEG, with these types.
struct ImageExtension {
    const char *name, *media_type;
};
inline constexpr ImageExtension image_extensions[] = {{"EXT_texture_webp", "image/webp"},
                                                      {"KHR_texture_basisu", "image/ktx2"},
                                                      {"EXT_texture_avif", "image/avif"},
                                                      {"MSFT_texture_dds", "image/vnd-ms.dds"}};

/// glTF constants of wrap modes, by Wrap, and of filters.
inline constexpr std::array<std::uint32_t, 3> wrap_modes = {10497, 33648, 33071};
inline constexpr std::uint32_t gl_nearest = 9728, gl_linear = 9729;

/// glTF constants of primitives: those of triangles, and the largest one.
inline constexpr std::uint64_t triangle_list = 4, triangle_fan = 6;

/// object[key], or null if `object` is not an object or has no such key.
const Json& member(const Json& object, const char* key);

/// object[key][...], or null if one of the keys is missing.
template <class... Keys>
const Json& member(const Json& object, const char* key, Keys... keys) {
    return member(member(object, key), keys...);
}

/// Number of elements of the array object[key]; 0 if there is none.
std::uint64_t array_size(const Json& object, const char* key);

/// The elements of the array object[key], to be changed; none if there is no array.
std::span<Json> elements(Json& object, const char* key);

/// The index stored under `key`, or no_index if absent. \pre the document was validated
Index index_member(const Json& object, const char* key);

/// The index that a value is, if it is below `count`.
std::optional<Index> valid_index(const Json& value, std::uint64_t count);

/// The unsigned number stored under `key`, or `fallback`. \pre the document was validated
std::uint64_t unsigned_member(const Json& object, const char* key, std::uint64_t fallback);

/// The string stored under `key`, or an empty string.
std::string string_member(const Json& object, const char* key);

/// The mode of a primitive.
std::uint64_t primitive_mode(const Json& primitive);

/// Whether a primitive has triangles.
bool is_triangle_primitive(const Json& primitive);

/// Whether a primitive has triangles and positions.
bool has_triangles(const Json& primitive);

/// The image of a texture; if it has none, the first of one of its extensions; no_index: none.
Index texture_image(const Json& texture);

/// Removes object[holder][key], and object[holder] if that was its only member. Returns whether there was one.
bool erase_from(Json& object, const char* holder, const std::string& key);

/// Removes an extension of an object.
inline bool erase_extension(Json& object, const std::string& name) {
    return erase_from(object, "extensions", name);
}

/// Sets object[key] to an array, or removes it if the array is empty.
void set_or_erase(Json& object, const char* key, Json array);

/// The indices of the coarser levels of a node or material by MSFT_lod; null if it has none.
const Json& level_ids(const Json& object);

/// The JSON pointer that a channel of an animation targets by KHR_animation_pointer, or an empty string.
std::string animated_pointer(const Json& channel);

/// Removes the channels of animations for which keeps(animation, channel) is false, with the samplers that no other
/// channel has, and animations without channels.
void filter_channels(Json& document, const std::function<bool(const Json& animation, Json& channel)>& keeps);

/// The node to whose members a JSON pointer points; no_index if there is none.
Index pointed_node(std::string_view pointer);

/// Calls visit(index) for the materials of the primitives of a document, and of their variants.
template <class Visit>
void for_each_material(const Json& document, const Visit& visit) {
    const auto visit_in = [&](const Json& holder) {
        if (const Index material = index_member(holder, "material"); material != no_index) visit(material);
    };
    for (const Json& mesh : member(document, "meshes"))
        for (const Json& primitive : member(mesh, "primitives")) {
            visit_in(primitive);
            for (const Json& mapping : member(primitive, "extensions", "KHR_materials_variants", "mappings"))
                visit_in(mapping);
        }
}

/// Marks an object and all to which it leads, without recursion: objects may be nested deeper than the call stack allows.
/// \param marks  by object; what is marked already leads to nothing new
/// \param next   next(index): the JSON array of the indices to which a newly marked object leads, or null
template <class Next>
void mark_reachable(Index first, std::vector<std::uint8_t>& marks, const Next& next) {
    std::vector<Index> open = {first};
    while (!open.empty()) {
        const Index object = open.back();
        open.pop_back();
        if (std::exchange(marks[object], std::uint8_t{1})) continue;
        for (const Json& other : next(object)) open.push_back(other.get<Index>());
    }
}

/// Appends a step to a JSON pointer: "/accessors" and 3 give "/accessors/3".
std::string child_path(const std::string& where, std::uint64_t index);
std::string child_path(const std::string& where, const std::string& key);

/// The double with the shortest decimal text that reads back as the same float: 0.1f gives 0.1, not
/// 0.10000000149.
double shortest_decimal(float value);

/// Whether a member is a texture info, including those of unknown extensions: an object with an index, under
/// a key that ends with Texture.
bool is_texture_info(const std::string& key, const Json& value);

/// Calls visit(name, value) for every extension in `value` and its descendants, except in extras.
/// \tparam J  Json or const Json
template <class J, class Visit>
void for_each_extension(J& value, const Visit& visit) {
    if (!value.is_structured()) return;
    if (value.is_object()) {
        const auto found = value.find("extensions");
        if (found != value.end() && found->is_object())
            for (auto it = found->begin(); it != found->end(); ++it) visit(it.key(), it.value());
    }
    for (auto it = value.begin(); it != value.end(); ++it) {
        if (value.is_object() && it.key() == "extras") continue;
        for_each_extension(*it, visit);
    }
}

}  // namespace faqem::detail
