#include <algorithm>
#include <utility>

#include "asset/gltf/accessor.hpp"
#include "asset/gltf/write/writer.hpp"
#include "asset/scene/source_traits.hpp"

namespace faqem::detail {
namespace {

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
    if (array_size(mesh, "weights") != targets) mesh.erase("weights");
    if (targets == 0) erase_from(mesh, "extras", "targetNames");
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

}  // namespace

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
