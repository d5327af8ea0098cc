#include "asset/gltf/write/feature_metadata.hpp"

#include <algorithm>
#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace faqem::detail {
namespace {

constexpr std::uint64_t metadata_alignment = 8;  // of the views of property tables, bytes

/// The index that a member refers to, if it is below `count`.
std::optional<Index> valid_index(const Json& reference, std::uint64_t count) {
    if (!reference.is_number_unsigned() || reference.get<std::uint64_t>() >= count) return std::nullopt;
    return reference.get<Index>();
}

bool has_attribute(const Part& part, const std::string& name) {
    return std::ranges::any_of(part.custom_attributes,
                               [&](const CustomAttribute& own) { return own.name == name; });
}

/// Whether the UV sets of the part are those of the source.
bool has_source_uvs(const GltfWriter& writer, const Part& part) {
    const std::set<Index> materials(part.face_material.begin(), part.face_material.end());
    return std::ranges::none_of(materials, [&](Index material) {
        return material != no_index && writer.asset.materials[material].rebaked;
    });
}

/// Whether a texture info refers to a texture, and to a UV set of the source that the part has.
bool fits_texture(const GltfWriter& writer, const Part& part, const Json& info) {
    const Json& set = member(info, "texCoord");
    return valid_index(member(info, "index"), source_array(writer, "textures").size()) &&
           (set.is_null() || set.is_number_unsigned()) &&
           unsigned_member(info, "texCoord", 0) < part.uvs.size() && has_source_uvs(writer, part);
}

bool are_all_vertices(const std::optional<VertexNumbers>& vertices) {
    if (!vertices) return false;
    for (Index v = 0; v < vertices->size(); ++v)
        if ((*vertices)[v] != v) return false;
    return true;
}

/// Whether all elements of a list are indices of elements in the list of the same name in the document's extension, for
/// which `fits` is true.
template <class Fits>
bool all_fit(const GltfWriter& writer, const Json& metadata, const char* list, const Fits& fits) {
    const Json& of_document = member(source_array(writer, "extensions"), metadata_name, list);
    for (const Json& reference : member(metadata, list)) {
        const std::optional<Index> index =
            valid_index(reference, of_document.is_array() ? of_document.size() : 0);
        if (!index) return false;
        for (const Json& property : member(of_document[*index], "properties"))
            if (!fits(property)) return false;
    }
    return true;
}

/// Members of the properties in a list of the extension that refer to objects of the document.
struct ReferenceKeys {
    const char* list;
    std::vector<const char*> keys;
};
const ReferenceKeys view_keys = {"propertyTables", {"values", "arrayOffsets", "stringOffsets"}};
const ReferenceKeys texture_keys = {"propertyTextures", {"index"}};

/// Calls visit(reference) for such members. Returns false if a call does, or if the list is malformed.
template <class Visit>
bool visit_references(Json& metadata, const ReferenceKeys& which, const Visit& visit) {
    if (!metadata.is_object()) return false;
    if (!metadata.contains(which.list)) return true;
    if (!metadata[which.list].is_array()) return false;
    for (Json& element : metadata[which.list]) {
        if (!element.is_object()) return false;
        if (!element.contains("properties")) continue;
        for (Json& property : element["properties"]) {
            if (!property.is_object()) return false;
            for (const char* key : which.keys)
                if (property.contains(key) && !visit(property[key])) return false;
        }
    }
    return true;
}

}  // namespace

bool keep_feature_ids(GltfWriter& writer, const Part& part, const std::optional<VertexNumbers>& vertices,
                      Json& extensions) {
    if (!member(extensions, features_name, "featureIds").is_array()) return false;
    Json valid = Json::array();
    const Json& all = extensions[features_name]["featureIds"];
    for (const Json& ids : all) {
        Json own = ids;
        const Json& attribute = member(ids, "attribute");
        const bool has_texture = member(ids, "texture").is_object();
        bool is_valid = false;
        if (ids.contains("attribute"))
            is_valid = attribute.is_number_unsigned() &&
                       has_attribute(part, "_FEATURE_ID_" + std::to_string(attribute.get<std::uint64_t>()));
        else if (has_texture)
            is_valid = fits_texture(writer, part, ids["texture"]);
        else
            is_valid = ids.is_object() && !ids.contains("texture") && are_all_vertices(vertices);
        if (!is_valid) continue;
        if (has_texture && !ids.contains("attribute"))
            own["texture"]["index"] = copy_texture(writer, ids["texture"]["index"].get<Index>());
        valid.push_back(std::move(own));
    }
    if (valid.empty()) return false;
    if (valid.size() < all.size())
        writer.warnings.push_back(
            "mesh '" + part.name +
            "': feature ids that the new vertices or texture coordinates do not have were left "
            "out");
    extensions[features_name]["featureIds"] = std::move(valid);
    return true;
}

bool fits_metadata(const GltfWriter& writer, const Part& part, const Json& extensions) {
    const Json& metadata = member(extensions, metadata_name);
    return metadata.is_object() &&
           all_fit(writer, metadata, "propertyAttributes",
                   [&](const Json& property) {
                       return has_attribute(part, string_member(property, "attribute"));
                   }) &&
           all_fit(writer, metadata, "propertyTextures",
                   [&](const Json& property) { return fits_texture(writer, part, property); });
}

void remap_structural_metadata(GltfWriter& writer) {
    if (!member(writer.out, "extensions").contains(metadata_name)) return;
    Json& extensions = writer.out["extensions"];
    Json metadata = extensions[metadata_name];
    const std::uint64_t views = source_array(writer, "bufferViews").size(),
                        textures = source_array(writer, "textures").size();
    const auto is_below = [](std::uint64_t count) {
        return [count](const Json& reference) { return valid_index(reference, count).has_value(); };
    };
    const bool is_valid = visit_references(metadata, view_keys, is_below(views)) &&
                          visit_references(metadata, texture_keys, is_below(textures));
    if (!is_valid) {
        writer.warnings.push_back(
            "EXT_structural_metadata refers to buffer views or textures that do not exist and was left out");
        erase_extension(writer.out, metadata_name);
        return;
    }
    std::map<Index, Index> copied;  // views of the source
    visit_references(metadata, view_keys, [&](Json& reference) {
        const auto view = reference.get<Index>();
        reference = once(copied, view, [&] {
            return writer.binary.add_view(
                view_bytes(writer.source, source_array(writer, "bufferViews")[view]), metadata_alignment);
        });
        return true;
    });
    visit_references(metadata, texture_keys, [&](Json& reference) {
        reference = copy_texture(writer, reference.get<Index>());
        return true;
    });
    extensions[metadata_name] = std::move(metadata);
}

}  // namespace faqem::detail
