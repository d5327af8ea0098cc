#include "asset/gltf/write/levels.hpp"

#include <cstdint>
#include <utility>

#include "asset/gltf/scene.hpp"
#include "asset/gltf/write/mesh_grid.hpp"
#include "asset/gltf/write/writer.hpp"

namespace faqem::detail {

namespace {

/// Whether the mesh of a node must be moved to a child node. Otherwise the nodes of the other levels, which
/// are not in the scene, would need copies of its transform, children, camera or animation.
bool needs_child_node(const Json& node, bool is_animated) {
    for (const char* key : {"children", "matrix", "translation", "rotation", "scale", "camera"})
        if (node.contains(key)) return true;
    return is_animated;
}

/// Lets the animations of the morph weights of a node move another node, too.
void copy_weight_channels(Json& document, Index from, Index to) {
    for (Json& animation : elements(document, "animations")) {
        Json& channels = animation["channels"];
        const std::size_t count = channels.size();
        for (std::size_t c = 0; c < count; ++c) {
            const Json& target = channels[c]["target"];
            if (index_member(target, "node") != from || string_member(target, "path") != "weights") continue;
            Json copy = channels[c];
            copy["target"]["node"] = to;
            channels.push_back(std::move(copy));
        }
    }
}

/// Creates the node of another level: the members of `mesh_node` with the mesh of the level, or no mesh if
/// the level has none.
Json level_node(const GltfWriter& writer, const Json& mesh_node, Index mesh, std::size_t level) {
    Json node = Json::object();
    if (mesh_node.contains("name"))
        node["name"] = string_member(mesh_node, "name") + "_LOD" + std::to_string(level);
    if (mesh == no_index) return node;
    node["mesh"] = mesh;
    const Json& primitive = writer.out["meshes"][mesh]["primitives"][0];
    if (mesh_node.contains("skin") && primitive["attributes"].contains("JOINTS_0"))
        node["skin"] = mesh_node["skin"];
    const Json& mesh_weights = member(writer.out["meshes"][index_member(mesh_node, "mesh")], "weights");
    const Json& weights = mesh_node.contains("weights") ? mesh_node["weights"] : mesh_weights;
    if (weights.is_array() && weights.size() == array_size(primitive, "targets")) node["weights"] = weights;
    if (member(mesh_node, "extensions").contains(instancing_name))
        node["extensions"][instancing_name] = mesh_node["extensions"][instancing_name];
    return node;
}

}  // namespace

void attach_levels(GltfWriter& writer, const LeveledAsset& leveled, const std::vector<Index>& mesh) {
    const std::vector<std::uint8_t> is_animated = animated_nodes(writer.out);
    std::vector<std::size_t> part_of_mesh(array_size(writer.out, "meshes"), leveled.parts_per_level);
    for (std::size_t p = 0; p < leveled.parts_per_level; ++p)
        if (mesh[p] != no_index) part_of_mesh[mesh[p]] = p;
    for (Index n = 0; n < is_animated.size(); ++n) {
        const Index node_mesh = index_member(writer.out["nodes"][n], "mesh");
        const std::size_t part = node_mesh == no_index ? leveled.parts_per_level : part_of_mesh[node_mesh];
        if (part == leveled.parts_per_level) continue;
        const bool is_split = needs_child_node(writer.out["nodes"][n], is_animated[n] != 0);
        const Index mesh_node = is_split ? move_mesh_to_child(writer, n) : n;
        Json ids = Json::array();
        for (std::size_t level = 1; level < leveled.levels(); ++level) {
            const Index level_mesh = mesh[level * leveled.parts_per_level + part];
            Json node = level_node(writer, writer.out["nodes"][mesh_node], level_mesh, level);
            const Index level_index = append(writer, "nodes", std::move(node));
            const Index targets = morph_target_count(writer, level_mesh);
            if (targets > 0 && targets == morph_target_count(writer, node_mesh))
                copy_weight_channels(writer.out, mesh_node, level_index);
            ids.push_back(level_index);
        }
        if (ids.empty()) continue;
        Json& json = writer.out["nodes"][mesh_node];
        json["extensions"][lod_name] = {{"ids", std::move(ids)}};
        const Json& extras = member(json, "extras");
        if (extras.is_null() || extras.is_object())  // extras may be of any JSON type
            json["extras"][coverage_name] = leveled.coverage[part];
    }
}

}  // namespace faqem::detail
