#include "asset/gltf/levels.hpp"

#include <array>
#include <utility>

#include "asset/gltf/write/writer.hpp"

namespace faqem::detail {

namespace {

constexpr const char* lod = "MSFT_lod";
constexpr const char* instancing = "EXT_mesh_gpu_instancing";

/// What goes along with a mesh when it moves to another node.
constexpr std::array<const char*, 3> mesh_keys = {"mesh", "skin", "weights"};

bool is_animated(const Json& document, Index node) {
    for (const Json& animation : member(document, "animations"))
        for (const Json& channel : member(animation, "channels"))
            if (index_of(member(channel, "target"), "node") == node) return true;
    return false;
}

/// Its levels would need what is not theirs.
bool needs_child(const Json& document, Index node) {
    const Json& json = document["nodes"][node];
    for (const char* key : {"children", "matrix", "translation", "rotation", "scale", "camera"})
        if (json.contains(key)) return true;
    return is_animated(document, node);
}

void follow_weights(Json& document, Index from, Index to) {
    if (!document.contains("animations")) return;
    for (Json& animation : document["animations"])
        for (Json& channel : animation["channels"]) {
            Json& target = channel["target"];
            if (index_of(target, "node") == from && string_of(target, "path") == "weights")
                target["node"] = to;
        }
}

/// The node that has the mesh and nothing that its levels would need.
Index holder(GltfWriter& writer, Index node) {
    if (!needs_child(writer.out, node)) return node;
    Json child = Json::object();
    Json& parent = writer.out["nodes"][node];
    if (parent.contains("name")) child["name"] = string_of(parent, "name") + "_mesh";
    for (const char* key : mesh_keys) {
        if (!parent.contains(key)) continue;
        child[key] = parent[key];
        parent.erase(key);
    }
    if (member(parent, "extensions").contains(instancing)) {
        child["extensions"][instancing] = parent["extensions"][instancing];
        parent["extensions"].erase(instancing);
        if (parent["extensions"].empty()) parent.erase("extensions");
    }
    const Index index = append(writer, "nodes", std::move(child));
    writer.out["nodes"][node]["children"].push_back(index);
    follow_weights(writer.out, node, index);
    return index;
}

/// A node like the holder with the mesh of another level, or without one where the level has none.
Json level_node(const GltfWriter& writer, const Json& holder, Index mesh, std::size_t level) {
    Json node = Json::object();
    if (holder.contains("name")) node["name"] = string_of(holder, "name") + "_LOD" + std::to_string(level);
    if (mesh == no_index) return node;
    node["mesh"] = mesh;
    const Json& primitive = writer.out["meshes"][mesh]["primitives"][0];
    if (holder.contains("skin") && primitive["attributes"].contains("JOINTS_0"))
        node["skin"] = holder["skin"];
    const Json& standard = member(writer.out["meshes"][index_of(holder, "mesh")], "weights");
    const Json& weights = holder.contains("weights") ? holder["weights"] : standard;
    if (weights.is_array() && weights.size() == array_size(primitive, "targets")) node["weights"] = weights;
    if (member(holder, "extensions").contains(instancing))
        node["extensions"][instancing] = holder["extensions"][instancing];
    return node;
}

}  // namespace

void attach_levels(GltfWriter& writer, const LeveledAsset& leveled, const std::vector<Index>& mesh) {
    const std::size_t nodes = array_size(writer.out, "nodes");
    std::vector<std::size_t> part_of(array_size(writer.out, "meshes"), leveled.parts);
    for (std::size_t p = 0; p < leveled.parts; ++p)
        if (mesh[p] != no_index) part_of[mesh[p]] = p;
    for (Index n = 0; n < nodes; ++n) {
        const Index own = index_of(writer.out["nodes"][n], "mesh");
        const std::size_t part = own == no_index ? leveled.parts : part_of[own];
        if (part == leveled.parts) continue;
        const Index high = holder(writer, n);
        Json ids = Json::array();
        for (std::size_t level = 1; level < leveled.levels(); ++level) {
            const Index low = mesh[level * leveled.parts + part];
            Json node = level_node(writer, writer.out["nodes"][high], low, level);
            ids.push_back(append(writer, "nodes", std::move(node)));
        }
        if (ids.empty()) continue;
        Json& json = writer.out["nodes"][high];
        json["extensions"][lod] = {{"ids", std::move(ids)}};
        const Json& extras = member(json, "extras");
        if (extras.is_null() || extras.is_object())  // they may be anything
            json["extras"]["MSFT_screencoverage"] = leveled.coverage[part];
    }
}

}  // namespace faqem::detail
