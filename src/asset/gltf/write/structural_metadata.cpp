#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "asset/gltf/accessor.hpp"
#include "asset/gltf/write/writer.hpp"

namespace faqem::detail {
namespace {

constexpr std::uint64_t metadata_alignment = 8;  // of the views of property tables, bytes

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
