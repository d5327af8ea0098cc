#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <utility>

#include "asset/gltf/accessor.hpp"
#include "asset/gltf/scene.hpp"
#include "asset/gltf/write/mesh_grid.hpp"
#include "asset/gltf/write/writer.hpp"
#include "asset/scene/affine.hpp"

namespace faqem::detail {
namespace {

/// Node members that are moved to another node together with the mesh.
constexpr std::array<const char*, 3> mesh_members = {"mesh", "skin", "weights"};

/// Node members beside which a node may itself restore the size of its mesh: nothing else depends on its transform.
constexpr std::array<std::string_view, 8> scalable_members = {"mesh",        "weights",  "name",  "extras",
                                                              "translation", "rotation", "scale", "matrix"};

Matrix4 matrix_of(const MeshGrid& grid) {
    return transform_matrix(grid.offset(), {0, 0, 0, 1}, {grid.spacing, grid.spacing, grid.spacing});
}

bool is_grid_node(const GltfWriter& writer, const Json& node) {
    const Index mesh = index_member(node, "mesh");
    return mesh != no_index && writer.grids[mesh].needs_transform();
}

/// The beginning of JSON pointers to members of a node.
std::string pointer_to(Index node) { return "/nodes/" + std::to_string(node) + "/"; }

void retarget_weight_channels(Json& document, Index from, Index to) {
    for (Json& animation : elements(document, "animations"))
        for (Json& channel : animation["channels"]) {
            Json& target = channel["target"];
            if (index_member(target, "node") == from && string_member(target, "path") == "weights")
                target["node"] = to;
            const std::string pointer = animated_pointer(channel), weights = pointer_to(from) + "weights";
            if (pointer == weights || pointer.starts_with(weights + "/"))
                target["extensions"]["KHR_animation_pointer"]["pointer"] =
                    pointer_to(to) + pointer.substr(pointer_to(from).size());
        }
}

/// Multiplies the transform of a node by that of a grid.
void scale_node(Json& node, const MeshGrid& grid) {
    const Matrix4 m = product(local_transform(node), matrix_of(grid));
    if (node.contains("matrix")) {
        node["matrix"] = m;
        return;
    }
    if (grid.origin != std::array<std::int64_t, 3>{}) node["translation"] = {m[12], m[13], m[14]};
    auto scale = number_array<3>(node, "scale", {1, 1, 1});
    for (double& s : scale) s *= grid.spacing;
    node["scale"] = scale;
}

/// Whether nothing but the mesh of a node that is not animated depends on its transform.
bool may_be_scaled(const Json& node) {
    for (const auto& [key, value] : node.items())
        if (std::ranges::find(scalable_members, key) == scalable_members.end()) return false;
    return true;
}

template <std::size_t N>
Index add_floats(GltfWriter& writer, const std::vector<std::array<float, N>>& values, const char* type,
                 AccessorUse use) {
    return writer.binary.add_accessor(accessor_description(NumberType::f32, type, values.size()),
                                      bytes_of(values), use);
}

/// Copies the instances of a node. Those of a mesh on a grid are scaled, which a transform of the node could not do.
void write_instances(GltfWriter& writer, Json& node) {
    Json& attributes = node["extensions"][instancing_name]["attributes"];
    const bool is_on_grid = is_grid_node(writer, node);
    std::vector<Vec3f> translations, scales;
    if (is_on_grid) {
        const MeshGrid& grid = writer.grids[node["mesh"].get<Index>()];
        for (const Matrix4& m : instance_matrices(writer.source, node))
            translations.push_back(converted<float>(transformed_point(m, grid.offset())));
        const Index scale = index_member(attributes, "SCALE");
        if (scale != no_index) scales = read_vectors<float, 3>(writer.source, scale);
        scales.resize(translations.size(), {1, 1, 1});
        for (Vec3f& s : scales)
            for (float& x : s) x = static_cast<float>(x * grid.spacing);
    }
    for (auto& [name, accessor] : attributes.items())
        if (!is_on_grid || (name != "TRANSLATION" && name != "SCALE"))
            accessor = copy_accessor(writer, accessor.get<Index>(), AccessorUse::other);
    if (!is_on_grid) return;
    attributes["TRANSLATION"] = add_floats(writer, translations, "VEC3", AccessorUse::other);
    attributes["SCALE"] = add_floats(writer, scales, "VEC3", AccessorUse::other);
}

/// Writes the inverse bind matrices of a skin, multiplied by the transform of a grid.
void write_bind_matrices(GltfWriter& writer, Json& skin, const MeshGrid& grid) {
    const Index accessor = index_member(skin, "inverseBindMatrices");
    if (!grid.needs_transform()) {
        if (accessor != no_index)
            skin["inverseBindMatrices"] = copy_accessor(writer, accessor, AccessorUse::matrices);
        return;
    }
    std::vector<std::array<float, 16>> matrices;
    for (const Matrix4& m : inverse_binds(writer.source, skin).matrices)
        matrices.push_back(converted<float>(product(m, matrix_of(grid))));
    skin["inverseBindMatrices"] = add_floats(writer, matrices, "MAT4", AccessorUse::matrices);
}

/// Gives each skin the inverse bind matrices for the grid of its meshes. A skin of meshes with several grids is copied.
void place_skins(GltfWriter& writer) {
    const std::size_t skins = array_size(writer.out, "skins");
    std::vector<std::vector<std::pair<MeshGrid, Index>>> copies(skins);  // by skin: grids, and skins for them
    for (Json& node : elements(writer.out, "nodes")) {
        const Index skin = index_member(node, "skin"), mesh = index_member(node, "mesh");
        if (skin == no_index || mesh == no_index) continue;
        MeshGrid grid = writer.grids[mesh];
        if (!grid.needs_transform()) grid = {};
        auto& own = copies[skin];
        auto found = std::ranges::find_if(own, [&](const auto& copy) {
            return copy.first.spacing == grid.spacing && copy.first.origin == grid.origin;
        });
        if (found == own.end()) {
            const Index copy = own.empty() ? skin : append(writer, "skins", Json(writer.out["skins"][skin]));
            own.push_back({grid, copy});
            found = own.end() - 1;
        }
        node["skin"] = found->second;
    }
    for (Index skin = 0; skin < skins; ++skin) {
        if (copies[skin].empty()) write_bind_matrices(writer, writer.out["skins"][skin], {});
        for (const auto& [grid, copy] : copies[skin])
            write_bind_matrices(writer, writer.out["skins"][copy], grid);
    }
}

}  // namespace

Index move_mesh_to_child(GltfWriter& writer, Index node) {
    Json child = Json::object();
    Json& parent = writer.out["nodes"][node];
    if (parent.contains("name")) child["name"] = string_member(parent, "name") + "_mesh";
    for (const char* key : mesh_members) {
        if (!parent.contains(key)) continue;
        child[key] = parent[key];
        parent.erase(key);
    }
    if (member(parent, "extensions").contains(instancing_name)) {
        child["extensions"][instancing_name] = parent["extensions"][instancing_name];
        erase_extension(parent, instancing_name);
    }
    const Index index = append(writer, "nodes", std::move(child));
    writer.out["nodes"][node]["children"].push_back(index);
    retarget_weight_channels(writer.out, node, index);
    return index;
}

bool any_needs_transform(const GltfWriter& writer) {
    return std::ranges::any_of(writer.grids, [](const MeshGrid& grid) { return grid.needs_transform(); });
}

void place_grids(GltfWriter& writer) {
    if (!any_needs_transform(writer)) return;
    const std::vector<std::uint8_t> is_animated = animated_nodes(writer.out);
    for (Index n = 0; n < is_animated.size(); ++n) {
        Json& node = writer.out["nodes"][n];
        if (member(node, "extensions", instancing_name).contains("attributes")) {
            write_instances(writer, node);
            continue;
        }
        if (!is_grid_node(writer, node) || node.contains("skin")) continue;
        const MeshGrid grid = writer.grids[node["mesh"].get<Index>()];
        const bool is_free = !is_animated[n] && may_be_scaled(node);
        const Index scaled = is_free ? n : move_mesh_to_child(writer, n);
        scale_node(writer.out["nodes"][scaled], grid);
    }
    place_skins(writer);
}

}  // namespace faqem::detail
