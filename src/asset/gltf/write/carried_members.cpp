// Extras and extensions that output primitives and meshes keep from the source. Extensions that refer to the vertices and
// triangles by their numbers (CESIUM_primitive_outline, EXT_mesh_manifold, FB_ngon_encoding) are kept where the triangles
// are those of the source, and feature ids with their properties where the vertices have them.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>

#include "asset/gltf/accessor.hpp"
#include "asset/gltf/write/writer.hpp"
#include "asset/scene/affine.hpp"
#include "faqem/engine/mesh/index_lists.hpp"

namespace faqem::detail {
namespace {

/// The output vertex of each vertex of a source primitive; no_index for those that no triangle uses.
using VertexNumbers = std::vector<Index>;

/// The numbers in an accessor that an extension refers to; none if it is no accessor of unsigned integers.
std::optional<std::vector<Index>> referenced_numbers(const GltfWriter& writer, const Json& reference) {
    const Json& accessors = source_array(writer, "accessors");
    const std::optional<Index> index = valid_index(reference, accessors.size());
    if (!index || string_member(accessors[*index], "type") != "SCALAR" ||
        !is_index_type(component_type(accessors[*index])))
        return std::nullopt;
    return read_indices(writer.source, *index);
}

/// The output vertices in an accessor of source vertices; none if one of them has no number.
std::optional<std::vector<Index>> renumbered(const GltfWriter& writer, const VertexNumbers& vertices,
                                             const Json& reference) {
    std::optional<std::vector<Index>> numbers = referenced_numbers(writer, reference);
    if (!numbers) return std::nullopt;
    for (Index& number : *numbers) {
        if (number >= vertices.size() || vertices[number] == no_index) return std::nullopt;
        number = vertices[number];
    }
    return numbers;
}

/// Compares an output primitive with a source primitive.
/// \param source  a primitive of the source document, or null
/// \return none unless the triangles are the same: as many, in the same order, with corners at the same positions, and
///         each vertex of one side is one vertex of the other
/// Complexity: O(vertices + corners).
std::optional<VertexNumbers> unchanged_vertices(const GltfWriter& writer, const Json& source,
                                                const PrimitiveData& data) {
    const Index position = index_member(member(source, "attributes"), "POSITION");
    if (position == no_index || primitive_mode(source) != triangle_list) return std::nullopt;
    const std::vector<Vec3> positions = read_vectors<double, 3>(writer.source, position);
    const std::vector<Index> corners = source.contains("indices")
                                           ? read_indices(writer.source, index_member(source, "indices"))
                                           : engine::all_indices(positions.size());
    if (corners.size() != data.corners.size()) return std::nullopt;
    VertexNumbers to(positions.size(), no_index);
    std::vector<Index> from(data.vertices.size(), no_index);
    for (std::size_t c = 0; c < corners.size(); ++c) {
        const Index old_vertex = corners[c], new_vertex = data.corners[c];
        if (to[old_vertex] == no_index && from[new_vertex] == no_index) {
            if (converted<float>(positions[old_vertex]) != data.positions[new_vertex]) return std::nullopt;
            to[old_vertex] = new_vertex;
            from[new_vertex] = old_vertex;
        }
        if (to[old_vertex] != new_vertex || from[new_vertex] != old_vertex) return std::nullopt;
    }
    return to;
}

/// Replaces the references of the extensions of a primitive.
/// \param vertices    as unchanged_vertices() gives them
/// \param extensions  of the output primitive, copied from the source; those that refer to vertices without a number, or
///                    to no valid accessor, are left for the caller to remove
/// \return names of the extensions that fit the output
std::vector<std::string> remap_index_extensions(GltfWriter& writer, const VertexNumbers& vertices,
                                                Json& extensions) {
    std::vector<std::string> valid;
    if (extensions.contains(ngon_name)) valid.emplace_back(ngon_name);
    if (!extensions.contains(outline_name)) return valid;
    const auto outline = renumbered(writer, vertices, member(extensions[outline_name], "indices"));
    if (!outline) return valid;
    extensions[outline_name]["indices"] = writer.binary.add_indices(*outline, AccessorUse::other);
    valid.emplace_back(outline_name);
    return valid;
}

/// Replaces the references of EXT_mesh_manifold of a mesh with one primitive.
/// \param manifold   the extension, copied from the source
/// \param corners    number of corners of the output primitive
/// \param primitive  the output primitive
/// \return false if it does not fit; it is unchanged then
bool remap_manifold(GltfWriter& writer, const VertexNumbers& vertices, std::size_t corners,
                    const Json& primitive, Json& manifold) {
    const Json& joined = member(manifold, "manifoldPrimitive");
    const auto indices = renumbered(writer, vertices, member(joined, "indices"));
    if (!indices || indices->size() != corners) return false;
    const auto add_numbers = [&](const std::vector<Index>& numbers) {
        return writer.binary.add_indices(numbers, AccessorUse::other);
    };
    Json result = manifold;
    for (const auto& [name, accessor] : member(joined, "attributes").items()) {
        if (!member(primitive, "attributes").contains(name)) return false;
        result["manifoldPrimitive"]["attributes"][name] = primitive["attributes"][name];
    }
    const bool is_merged = manifold.contains("mergeIndices") || manifold.contains("mergeValues");
    if (is_merged) {
        const auto moved = referenced_numbers(writer, member(manifold, "mergeIndices"));
        const auto values = renumbered(writer, vertices, member(manifold, "mergeValues"));
        if (!moved || !values || moved->size() != values->size() ||
            std::any_of(moved->begin(), moved->end(), [&](Index corner) { return corner >= corners; }))
            return false;
        result["mergeIndices"] = add_numbers(*moved);
        result["mergeValues"] = add_numbers(*values);
    }
    result["manifoldPrimitive"]["indices"] = add_numbers(*indices);
    manifold = std::move(result);
    return true;
}

bool has_attribute(const Part& part, const std::string& name) {
    return std::ranges::any_of(part.custom_attributes,
                               [&](const CustomAttribute& own) { return own.name == name; });
}

/// Whether the UV sets of the part are those of the source.
bool has_source_uvs(const GltfWriter& writer, const Part& part) {
    return std::ranges::none_of(part.face_material, [&](Index material) {
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

/// Whether all elements of a list are indices of elements in the list of the same name in the document's extension, for
/// which `fits` is true.
template <class Fits>
bool all_fit(const GltfWriter& writer, const Json& metadata, const char* list, const Fits& fits) {
    const Json& of_document = member(source_array(writer, "extensions"), metadata_name);
    for (const Json& reference : member(metadata, list)) {
        const std::optional<Index> index = valid_index(reference, array_size(of_document, list));
        if (!index) return false;
        for (const Json& property : member(of_document[list][*index], "properties"))
            if (!fits(property)) return false;
    }
    return true;
}

/// Keeps the feature ids of EXT_mesh_features that fit a primitive, with remapped textures: those in vertex attributes
/// that the part has, those in textures if the part has the UVs of the source, and the numbers of vertices if all are
/// those of the source. Others are left out, with a warning if any are kept.
/// \param vertices    as unchanged_vertices() gives them
/// \param extensions  of the output primitive, copied from the source
/// \return whether any are left
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
            is_valid = ids.is_object() && !ids.contains("texture") && vertices &&
                       *vertices == engine::all_indices(vertices->size());
        if (!is_valid) continue;
        if (has_texture && !ids.contains("attribute"))
            own["texture"]["index"] = copy_texture(writer, ids["texture"]["index"].get<Index>());
        valid.push_back(std::move(own));
    }
    if (valid.empty()) return false;
    if (valid.size() < all.size())
        warn_mesh(writer, part.name,
                  "feature ids that the new vertices or texture coordinates do not have were left out");
    extensions[features_name]["featureIds"] = std::move(valid);
    return true;
}

/// Whether EXT_structural_metadata of a primitive fits: the part has the attributes, and for textures the UVs of the
/// source, to which it refers.
/// \param extensions  of the output primitive, copied from the source
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

/// The source primitives that correspond to the primitive of a part with this material.
std::vector<const Json*> source_primitives(const GltfWriter& writer, const Part& part,
                                           const Material* material) {
    std::vector<const Json*> found;
    const Index mesh = source_mesh(writer, part);
    if (mesh >= array_size(writer.source.document, "meshes")) return found;
    const bool any = material && (material->rebaked || material->source == no_index);
    const Index wanted = material ? material->source : no_index;
    for (const Json& primitive : member(source_array(writer, "meshes")[mesh], "primitives"))
        if (is_triangle_primitive(primitive) && (any || index_member(primitive, "material") == wanted))
            found.push_back(&primitive);
    return found;
}

/// The member `key` of the primitives; null if they have none or, with a warning, if it is not equal in all of them.
Json common_member(GltfWriter& writer, const Part& part, const std::vector<const Json*>& primitives,
                   const char* key) {
    const Json& first = member(*primitives.front(), key);
    if (std::ranges::all_of(primitives, [&](const Json* p) { return member(*p, key) == first; }))
        return first;
    warn_mesh(writer, part.name,
              std::string(key) + " of primitives that were joined differ and were left out");
    return nullptr;
}

/// Names of the extensions that describe vertices or triangles and fit the output primitive. Their references are
/// remapped.
/// \param from  the corresponding primitives of the source
std::vector<std::string> fitting_extensions(GltfWriter& writer, const Part& part,
                                            const std::vector<const Json*>& from, const PrimitiveData& data,
                                            Json& extensions) {
    const bool has_any =
        std::ranges::any_of(vertex_extensions, [&](const char* name) { return extensions.contains(name); });
    if (!has_any) return {};
    std::optional<VertexNumbers> vertices;
    if (from.size() == 1 && part.file_order == FileOrder::given)
        vertices = unchanged_vertices(writer, *from.front(), data);
    std::vector<std::string> fitting;
    if (vertices) fitting = remap_index_extensions(writer, *vertices, extensions);
    if (keep_feature_ids(writer, part, vertices, extensions)) fitting.emplace_back(features_name);
    if (fits_metadata(writer, part, extensions)) fitting.emplace_back(metadata_name);
    return fitting;
}

}  // namespace

void warn_mesh(GltfWriter& writer, const std::string& name, const std::string& what) {
    writer.warnings.push_back("mesh '" + name + "': " + what);
}

void remap_variants(GltfWriter& writer, Json& primitive) {
    if (!member(primitive, "extensions", variants_name).contains("mappings")) return;
    for (Json& mapping : primitive["extensions"][variants_name]["mappings"])
        mapping["material"] = write_source_material(writer, index_member(mapping, "material"));
}

Index source_mesh(const GltfWriter& writer, const Part& part) {
    const auto index = static_cast<std::size_t>(&part - writer.asset.parts.data());
    return index < writer.sources.size() ? writer.sources[index] : part.source;
}

void keep_manifold(GltfWriter& writer, const Part& part, const PrimitiveData& data, const Json& primitive,
                   Json& extensions) {
    const Index mesh = source_mesh(writer, part);
    if (mesh >= source_array(writer, "meshes").size() || part.file_order != FileOrder::given) return;
    const Json& source = source_array(writer, "meshes")[mesh];
    if (!member(source, "extensions").contains(manifold_name) || array_size(source, "primitives") != 1)
        return;
    const auto vertices = unchanged_vertices(writer, source["primitives"][0], data);
    Json manifold = source["extensions"][manifold_name];
    if (vertices && remap_manifold(writer, *vertices, data.corners.size(), primitive, manifold))
        extensions[manifold_name] = std::move(manifold);
}

Json carried_primitive_members(GltfWriter& writer, const Part& part, Index material_index,
                               const PrimitiveData& data) {
    const Material* material = material_index == no_index ? nullptr : &writer.asset.materials[material_index];
    const std::vector<const Json*> from = source_primitives(writer, part, material);
    Json members = Json::object();
    if (from.empty()) return members;
    if (Json extras = common_member(writer, part, from, "extras"); !extras.is_null())
        members["extras"] = std::move(extras);
    Json extensions = common_member(writer, part, from, "extensions");
    if (extensions.is_null()) return members;
    const std::vector<std::string> fitting = fitting_extensions(writer, part, from, data, extensions);
    const auto fits = [&](const auto& name) { return std::ranges::find(fitting, name) != fitting.end(); };
    for (const std::string name : vertex_extensions)
        if (!fits(name) && extensions.erase(name) != 0 && name != "KHR_draco_mesh_compression")
            warn_mesh(writer, part.name,
                      name + " does not fit the new vertices and triangles and was left out");
    // What an unknown extension says may not hold for other triangles.
    std::erase_if(extensions.get_ref<Json::object_t&>(), [&](const auto& extension) {
        const std::string& name = extension.first;
        if (part.file_order == FileOrder::given || name == variants_name || fits(name)) return false;
        warn_mesh(writer, part.name, name + " is not known, and may not fit the new triangles: left out");
        return true;
    });
    if (material && material->rebaked && extensions.erase(variants_name) != 0)
        warn_mesh(writer, part.name, "the material variants do not fit the new material and were left out");
    if (!extensions.empty()) members["extensions"] = std::move(extensions);
    remap_variants(writer, members);
    return members;
}

}  // namespace faqem::detail
