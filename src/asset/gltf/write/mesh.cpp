#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include "asset/gltf/accessor.hpp"
#include "asset/gltf/write/feature_metadata.hpp"
#include "asset/gltf/write/index_extensions.hpp"
#include "asset/gltf/write/writer.hpp"
#include "asset/scene/source_traits.hpp"

namespace faqem::detail {
namespace {

constexpr const char* variants_name = "KHR_materials_variants";

/// Extensions of primitives and meshes that describe the source vertices or triangles, which may no longer exist.
constexpr std::array<const char*, 6> vertex_extensions = {
    "KHR_draco_mesh_compression", "EXT_mesh_features", "EXT_structural_metadata",
    "CESIUM_primitive_outline",   "EXT_mesh_manifold", "FB_ngon_encoding"};

bool is_triangle_primitive(const Json& primitive) { return primitive_mode(primitive) >= triangle_list; }

void warn_mesh(GltfWriter& writer, const std::string& name, const std::string& what) {
    writer.warnings.push_back("mesh '" + name + "': " + what);
}

void remap_variants(GltfWriter& writer, Json& primitive) {
    if (!member(primitive, "extensions", variants_name).contains("mappings")) return;
    for (Json& mapping : primitive["extensions"][variants_name]["mappings"])
        mapping["material"] = write_source_material(writer, index_member(mapping, "material"));
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

/// The member `key` of the primitives if it is equal in all of them, else null.
Json common_member(const std::vector<const Json*>& primitives, const char* key) {
    const Json& first = member(*primitives.front(), key);
    for (const Json* primitive : primitives)
        if (member(*primitive, key) != first) return nullptr;
    return first;
}

bool any_has(const std::vector<const Json*>& primitives, const char* key) {
    return std::ranges::any_of(primitives, [&](const Json* p) { return p->contains(key); });
}

/// Whether the accessor type is allowed only with KHR_mesh_quantization.
bool is_quantized(const std::string& attribute, const Json& accessor) {
    const NumberType type = component_type(accessor);
    if (type == NumberType::f32) return false;
    if (attribute == "POSITION" || attribute == "NORMAL" || attribute == "TANGENT") return true;
    const bool is_unsigned_normalized =
        member(accessor, "normalized") == true && (type == NumberType::u8 || type == NumberType::u16);
    return attribute.starts_with("TEXCOORD_") && !is_unsigned_normalized;
}

void copy_attributes(GltfWriter& writer, Json& attributes) {
    for (auto& [name, accessor] : attributes.items()) {
        if (is_quantized(name, source_array(writer, "accessors")[accessor.get<Index>()]))
            writer.needs_quantization = true;
        accessor = copy_accessor(writer, accessor.get<Index>(), AccessorUse::vertices);
    }
}

/// Copies a primitive of points or lines from the source.
Json copy_primitive(GltfWriter& writer, const Json& source, const std::string& mesh) {
    Json primitive = source;
    copy_attributes(writer, primitive["attributes"]);
    for (Json& target : elements(primitive, "targets")) copy_attributes(writer, target);
    if (primitive.contains("indices"))
        primitive["indices"] =
            copy_accessor(writer, index_member(primitive, "indices"), AccessorUse::indices);
    if (primitive.contains("material"))
        primitive["material"] = write_source_material(writer, index_member(primitive, "material"));
    for (const std::string name : vertex_extensions)
        if (erase_extension(primitive, name))
            warn_mesh(writer, mesh, name + " of points or lines was left out");
    remap_variants(writer, primitive);
    return primitive;
}

/// Writes the materials in the asset's order, whichever mesh uses them first.
void write_used_materials(GltfWriter& writer) {
    write_numbered_objects(writer);
    const std::vector<Material>& materials = writer.asset.materials;
    std::vector<char> used(materials.size(), 0);
    for (const Part& part : writer.asset.parts)
        for (const Index material : part.face_material)
            if (material != no_index) used[material] = 1;
    // Material variants are left out if a material was rebaked.
    if (std::ranges::none_of(materials, [](const Material& m) { return m.rebaked; }))
        for (const Part& part : writer.asset.parts)
            for (const Index material : variant_materials(writer.asset, part)) used[material] = 1;
    for (Index i = 0; i < used.size(); ++i)
        if (used[i]) write_material(writer, i);
}

/// Removes weights and names of morph targets that do not match the number of targets.
void update_morph_targets(Json& mesh, std::uint64_t targets) {
    if (array_size(mesh, "weights") != targets) mesh.erase("weights");
    if (targets == 0) erase_from(mesh, "extras", "targetNames");
}

/// The grid of a mesh. Points and lines, which are copied, have no other positions than those of the source.
MeshGrid grid_of(GltfWriter& writer, const Json& source, const std::vector<const Part*>& parts) {
    // Draco stores rounded positions as floats.
    if (writer.asset.compression == Compression::draco) return {};
    std::string unfit;
    MeshGrid grid = choose_grid(parts, writer.origin, unfit);
    const Json& primitives = member(source, "primitives");
    if (grid.needs_transform() && !std::ranges::all_of(primitives, is_triangle_primitive)) {
        unfit = "it has points or lines";
        grid = {};
    }
    if (!unfit.empty()) warn_mesh(writer, parts.front()->name, "the positions are not quantised: " + unfit);
    return grid;
}

/// Appends a mesh with the given parts. Other members are copied from the source mesh.
/// \param source  source mesh, or null
/// \return index of the mesh; no_index if it has no primitives, which glTF does not allow
Index write_mesh(GltfWriter& writer, const Json& source, const std::vector<const Part*>& parts) {
    Json mesh = source.is_null() ? Json::object() : source;
    Json primitives = Json::array(), fitting = Json::object();
    std::uint64_t targets = 0;
    const MeshGrid grid = grid_of(writer, source, parts);
    for (const Part* part : parts) {
        write_part(writer, *part, grid, primitives, fitting);
        targets = std::max<std::uint64_t>(targets, part->morph_targets.size());
        if (!part->name.empty()) mesh["name"] = part->name;
    }
    const std::string name = string_member(mesh, "name");
    for (const Json& primitive : member(source, "primitives")) {
        if (is_triangle_primitive(primitive)) continue;
        primitives.push_back(copy_primitive(writer, primitive, name));
        targets = std::max(targets, array_size(primitive, "targets"));
    }
    if (primitives.empty()) {
        warn_mesh(writer, name, "has no primitives left and was left out");
        return no_index;
    }
    update_morph_targets(mesh, targets);
    for (const std::string extension : vertex_extensions)
        if (member(mesh, "extensions").contains(extension) && fitting.contains(extension) &&
            primitives.size() == 1)
            mesh["extensions"][extension] = fitting[extension];
        else if (erase_extension(mesh, extension))
            warn_mesh(writer, name, extension + " does not fit the new triangles and was left out");
    mesh["primitives"] = std::move(primitives);
    writer.grids.push_back(grid);
    return append(writer, "meshes", std::move(mesh));
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
    if (any_has(from, "extras")) {
        members["extras"] = common_member(from, "extras");
        if (members["extras"].is_null()) {
            members.erase("extras");
            warn_mesh(writer, part.name, "extras of primitives that were joined differ and were left out");
        }
    }
    if (!any_has(from, "extensions")) return members;
    Json extensions = common_member(from, "extensions");
    if (extensions.is_null()) {
        warn_mesh(writer, part.name, "extensions of primitives that were joined differ and were left out");
        return members;
    }
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

void write_meshes(GltfWriter& writer, std::vector<Index>& new_meshes) {
    const Json& sources = source_array(writer, "meshes");
    write_used_materials(writer);
    std::vector<std::vector<const Part*>> parts_of(sources.size());
    for (const Part& part : writer.asset.parts)
        if (part.source < parts_of.size()) parts_of[part.source].push_back(&part);
    for (Index mesh = 0; mesh < parts_of.size(); ++mesh) {
        const bool is_coarser_level = sources[mesh].is_null();  // by finest_level(), whose caller warned
        writer.mesh_map.push_back(is_coarser_level ? no_index
                                                   : write_mesh(writer, sources[mesh], parts_of[mesh]));
    }
    for (const Part& part : writer.asset.parts)
        if (part.source >= parts_of.size()) new_meshes.push_back(write_mesh(writer, Json(), {&part}));
}

}  // namespace faqem::detail
