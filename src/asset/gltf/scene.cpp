#include <utility>

#include "asset/gltf/gltf.hpp"
#include "asset/gltf/instancing.hpp"
#include "asset/gltf/scene.hpp"
#include "asset/gltf/source_document.hpp"
#include "asset/scene/affine.hpp"
#include "asset/scene/flatten.hpp"

namespace faqem::detail {
namespace {

using Matrix = std::array<double, 16>;

std::vector<Index> nodes_without_parent(const Json& document) {
    std::vector<Index> roots;
    const Json& nodes = member(document, "nodes");
    std::vector<char> is_child(nodes.size(), 0);
    for (const Json& node : nodes)
        for (const Json& child : member(node, "children")) is_child[child.get<Index>()] = 1;
    for (Index i = 0; i < nodes.size(); ++i)
        if (!is_child[i]) roots.push_back(i);
    return roots;
}

/// The nodes of the default scene, or of the first one; without scenes, all nodes without a parent.
std::vector<Index> root_nodes(const Json& document) {
    const Json& scenes = member(document, "scenes");
    if (scenes.empty()) return nodes_without_parent(document);
    std::vector<Index> roots;
    for (const Json& node : member(scenes[unsigned_member(document, "scene", 0)], "nodes"))
        roots.push_back(node.get<Index>());
    return roots;
}

/// Lists some nodes and their descendants, depth first.
std::vector<PlacedNode> placed_below(const Json& document, const std::vector<Index>& roots,
                                     std::span<const std::optional<std::array<double, 3>>> scales) {
    std::vector<PlacedNode> placed;
    // An explicit stack: nodes may be nested deeper than the call stack allows.
    std::vector<std::pair<Index, Matrix>> stack;
    for (auto root = roots.rbegin(); root != roots.rend(); ++root)
        stack.push_back({*root, identity_transform});
    while (!stack.empty()) {
        const auto [index, parent] = stack.back();
        stack.pop_back();
        const Json& node = document["nodes"][index];
        const Matrix world =
            product(parent, local_transform(node, scales.empty() ? std::nullopt : scales[index]));
        placed.push_back({index, world});
        const Json& children = member(node, "children");
        for (auto child = children.rbegin(); child != children.rend(); ++child)
            stack.push_back({child->get<Index>(), world});
    }
    return placed;
}

}  // namespace

Matrix local_transform(const Json& node, const std::optional<std::array<double, 3>>& scale) {
    if (node.contains("matrix")) return number_array<16>(node, "matrix", identity_transform);
    return transform_matrix(number_array<3>(node, "translation", {0, 0, 0}),
                            number_array<4>(node, "rotation", {0, 0, 0, 1}),
                            scale ? *scale : number_array<3>(node, "scale", {1, 1, 1}));
}

Matrix product(const Matrix& a, const Matrix& b) {
    Matrix c = {};
    for (std::size_t column = 0; column < 4; ++column)
        for (std::size_t row = 0; row < 4; ++row)
            for (std::size_t k = 0; k < 4; ++k) c[4 * column + row] += a[4 * k + row] * b[4 * column + k];
    return c;
}

std::vector<PlacedNode> placed_nodes(const Json& document,
                                     std::span<const std::optional<std::array<double, 3>>> scales) {
    return placed_below(document, root_nodes(document), scales);
}

std::vector<Matrix> node_transforms(const Json& document) {
    std::vector<Matrix> worlds(array_size(document, "nodes"), identity_transform);
    for (const PlacedNode& placed : placed_below(document, nodes_without_parent(document), {}))
        worlds[placed.node] = placed.world;
    return worlds;
}

std::vector<Instance> instances_at(const Asset& asset, std::span<const PlacedNode> nodes,
                                   std::vector<Index>* node_of) {
    const Json& document = asset.source->document;
    std::vector<std::vector<Index>> parts_of(array_size(document, "meshes"));
    std::vector<Instance> instances;
    std::vector<Index> unassigned_parts;
    for (Index i = 0; i < asset.parts.size(); ++i)
        if (asset.parts[i].source < parts_of.size())
            parts_of[asset.parts[i].source].push_back(i);
        else
            unassigned_parts.push_back(i);
    for (const auto& [index, world] : nodes) {
        const Json& node = document["nodes"][index];
        const Index mesh = index_member(node, "mesh");
        if (mesh == no_index || parts_of[mesh].empty()) continue;
        std::vector<Matrix> transforms = instance_matrices(*asset.source, node);
        if (transforms.empty()) transforms.push_back(identity_transform);
        for (const Matrix& transform : transforms)
            for (const Index part : parts_of[mesh]) instances.push_back({part, product(world, transform)});
        if (node_of) node_of->resize(instances.size(), index);
    }
    for (const Index part : unassigned_parts) instances.push_back({part, identity_transform});
    if (node_of) node_of->resize(instances.size(), no_index);
    return instances;
}

std::vector<Instance> gltf_instances(const Asset& asset) {
    return instances_at(asset, placed_nodes(asset.source->document));
}

std::optional<Vec3> scene_center(const Asset& asset) {
    if (!asset.source) return std::nullopt;
    const Json& extension = member(asset.source->document, "extensions", center_name);
    if (!extension.contains("center")) return std::nullopt;
    return number_array<3>(extension, "center", {0, 0, 0});
}

}  // namespace faqem::detail
