#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <memory>
#include <utility>

#include "asset/gltf/accessor.hpp"
#include "asset/gltf/scene.hpp"
#include "asset/scene/affine.hpp"
#include "asset/scene/repair.hpp"
#include "faqem/error.hpp"

namespace faqem::detail {
namespace {

const Json& instancing_attributes(const Json& node) {
    return member(node, "extensions", instancing_name, "attributes");
}

std::vector<Index> nodes_without_parent(const Json& document) {
    std::vector<Index> roots;
    const std::vector<Index> parents = parents_of(member(document, "nodes"));
    for (Index i = 0; i < parents.size(); ++i)
        if (parents[i] == no_index) roots.push_back(i);
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
                                     std::span<const std::optional<Vec3>> scales) {
    std::vector<PlacedNode> placed;
    // An explicit stack: nodes may be nested deeper than the call stack allows.
    std::vector<std::pair<Index, Matrix4>> stack;
    for (auto root = roots.rbegin(); root != roots.rend(); ++root)
        stack.push_back({*root, identity_transform});
    while (!stack.empty()) {
        const auto [index, parent] = stack.back();
        stack.pop_back();
        const Json& node = document["nodes"][index];
        const Matrix4 world =
            product(parent, local_transform(node, scales.empty() ? std::nullopt : scales[index]));
        placed.push_back({index, world});
        const Json& children = member(node, "children");
        for (auto child = children.rbegin(); child != children.rend(); ++child)
            stack.push_back({child->get<Index>(), world});
    }
    return placed;
}

/// The default morph weights of a node; empty if all are 0.
std::vector<double> default_morph_weights(const Json& document, const Json& node) {
    const Json& mesh = member(document, "meshes")[index_member(node, "mesh")];
    std::vector<double> weights;
    for (const Json& weight : member(node.contains("weights") ? node : mesh, "weights"))
        weights.push_back(weight.is_number() ? weight.get<double>() : 0);
    if (std::ranges::all_of(weights, [](double weight) { return weight == 0; })) return {};
    return weights;
}

bool is_skinned(const Part& part) { return !part.joints.empty() && !part.weights.empty(); }

/// The pose of the mesh at a node; null if nothing deforms it.
/// \param worlds  node_transforms(), which are computed once, when a skin needs them
std::shared_ptr<const RestPose> pose_of(const SourceDocument& source, const Json& node,
                                        std::vector<Matrix4>& worlds) {
    RestPose pose;
    pose.morph_weights = default_morph_weights(source.document, node);
    const Index skin = index_member(node, "skin");
    if (skin != no_index && !member(node, "extensions").contains(instancing_name)) {
        if (worlds.empty()) worlds = node_transforms(source.document);
        const Json& json = source.document["skins"][skin];
        pose.joints = inverse_binds(source, json).matrices;
        for (std::size_t j = 0; j < pose.joints.size(); ++j)
            pose.joints[j] = product(worlds[json["joints"][j].get<Index>()], pose.joints[j]);
    }
    if (pose.joints.empty() && pose.morph_weights.empty()) return nullptr;
    return std::make_shared<const RestPose>(std::move(pose));
}

}  // namespace

Matrix4 transform_matrix(const Vec3& t, const std::array<double, 4>& rotation, const Vec3& s) {
    const double length = std::sqrt(rotation[0] * rotation[0] + rotation[1] * rotation[1] +
                                    rotation[2] * rotation[2] + rotation[3] * rotation[3]);
    std::array<double, 4> q = rotation;
    if (length > 0)
        for (double& component : q) component /= length;
    const auto& [x, y, z, w] = q;
    const std::array<Vec3, 3> columns = {
        {{1 - 2 * (y * y + z * z), 2 * (x * y + z * w), 2 * (x * z - y * w)},
         {2 * (x * y - z * w), 1 - 2 * (x * x + z * z), 2 * (y * z + x * w)},
         {2 * (x * z + y * w), 2 * (y * z - x * w), 1 - 2 * (x * x + y * y)}}};
    Matrix4 matrix = {};
    for (std::size_t column = 0; column < 3; ++column)
        for (std::size_t row = 0; row < 3; ++row) matrix[4 * column + row] = columns[column][row] * s[column];
    std::ranges::copy(t, matrix.begin() + 12);
    matrix[15] = 1;
    return matrix;
}

std::vector<Matrix4> instance_matrices(const SourceDocument& source, const Json& node) {
    std::vector<Matrix4> matrices;
    const Json& attributes = instancing_attributes(node);
    if (attributes.empty()) return matrices;
    const Index any = attributes.begin()->get<Index>();
    const auto count =
        static_cast<std::size_t>(unsigned_member(member(source.document, "accessors")[any], "count", 0));
    const auto translation =
        vectors_or(source, index_member(attributes, "TRANSLATION"), count, Vec3{0, 0, 0});
    const auto rotation = vectors_or(source, index_member(attributes, "ROTATION"), count, Vec4f{0, 0, 0, 1});
    const auto scale = vectors_or(source, index_member(attributes, "SCALE"), count, Vec3{1, 1, 1});
    matrices.reserve(count);
    for (std::size_t i = 0; i < count; ++i)
        matrices.push_back(transform_matrix(translation[i], converted<double>(rotation[i]), scale[i]));
    return matrices;
}

void check_instances(const SourceDocument& source, const std::string& file) {
    const Json& nodes = member(source.document, "nodes");
    for (std::uint64_t i = 0; i < nodes.size(); ++i) {
        const Json& attributes = instancing_attributes(nodes[i]);
        const std::string where = child_path("/nodes", i) + "/extensions/" + instancing_name + "/attributes/";
        for (const char* name : {"TRANSLATION", "ROTATION", "SCALE"}) {
            const Index accessor = index_member(attributes, name);
            if (accessor == no_index) continue;
            const std::vector<Vec4f> values = read_vectors<float, 4>(source, accessor);
            const auto found = std::ranges::find_if_not(values, is_finite<float, 4>);
            if (found != values.end())
                throw InputError(file, where + name,
                                 "instance " + std::to_string(found - values.begin()) + " is not finite");
        }
    }
}

std::vector<Index> parents_of(const Json& nodes) {
    std::vector<Index> parents(nodes.size(), no_index);
    for (Index n = 0; n < nodes.size(); ++n)
        for (const Json& child : member(nodes[n], "children")) parents[child.get<Index>()] = n;
    return parents;
}

Matrix4 local_transform(const Json& node, const std::optional<Vec3>& scale) {
    if (node.contains("matrix")) return number_array<16>(node, "matrix", identity_transform);
    return transform_matrix(number_array<3>(node, "translation", {0, 0, 0}),
                            number_array<4>(node, "rotation", {0, 0, 0, 1}),
                            scale ? *scale : number_array<3>(node, "scale", {1, 1, 1}));
}

Matrix4 product(const Matrix4& a, const Matrix4& b) {
    Matrix4 c = {};
    for (std::size_t column = 0; column < 4; ++column)
        for (std::size_t row = 0; row < 4; ++row)
            for (std::size_t k = 0; k < 4; ++k) c[4 * column + row] += a[4 * k + row] * b[4 * column + k];
    return c;
}

std::vector<PlacedNode> placed_nodes(const Json& document, std::span<const std::optional<Vec3>> scales) {
    return placed_below(document, root_nodes(document), scales);
}

std::vector<Matrix4> node_transforms(const Json& document) {
    std::vector<Matrix4> worlds(array_size(document, "nodes"), identity_transform);
    for (const PlacedNode& placed : placed_below(document, nodes_without_parent(document), {}))
        worlds[placed.node] = placed.world;
    return worlds;
}

std::vector<Instance> instances_at(const Asset& asset, std::span<const PlacedNode> nodes,
                                   std::vector<Index>* node_of) {
    const Json& document = source_document(asset).document;
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
        std::vector<Matrix4> transforms = instance_matrices(source_document(asset), node);
        if (transforms.empty()) transforms.push_back(identity_transform);
        for (const Matrix4& transform : transforms)
            for (const Index part : parts_of[mesh]) instances.push_back({part, product(world, transform)});
        if (node_of) node_of->resize(instances.size(), index);
    }
    for (const Index part : unassigned_parts) instances.push_back({part, identity_transform});
    if (node_of) node_of->resize(instances.size(), no_index);
    return instances;
}

std::optional<Vec3> scene_center(const Asset& asset) {
    const Json& extension = member(source_document(asset).document, "extensions", center_name);
    if (!extension.contains("center")) return std::nullopt;
    return number_array<3>(extension, "center", {0, 0, 0});
}

std::vector<std::uint8_t> animated_nodes(const Json& document) {
    std::vector<std::uint8_t> result(array_size(document, "nodes"), 0);
    for (const Json& animation : member(document, "animations"))
        for (const Json& channel : member(animation, "channels")) {
            const Index target = index_member(member(channel, "target"), "node");
            if (target < result.size()) result[target] = 1;
            const Index pointed = pointed_node(animated_pointer(channel));
            if (pointed < result.size()) result[pointed] = 1;
        }
    return result;
}

InverseBinds inverse_binds(const SourceDocument& source, const Json& skin) {
    InverseBinds result;
    result.matrices.assign(member(skin, "joints").size(), identity_transform);
    const Index accessor = index_member(skin, "inverseBindMatrices");
    if (accessor == no_index) return result;
    const Json& layout = source.document["accessors"][accessor];
    if (string_member(layout, "type") != "MAT4" || component_type(layout) != NumberType::f32) return result;
    const std::vector<std::uint8_t> bytes = dense_bytes(source, accessor);
    std::array<float, 16> stored;
    for (std::size_t j = 0; j < result.matrices.size() && bytes.size() >= (j + 1) * sizeof stored; ++j) {
        std::memcpy(stored.data(), bytes.data() + j * sizeof stored, sizeof stored);
        if (is_finite(stored))
            std::ranges::copy(stored, result.matrices[j].begin());
        else
            ++result.repaired;
    }
    return result;
}

std::vector<PosedInstance> posed_instances(const Asset& asset) {
    std::vector<PosedInstance> posed;
    const Json& document = source_document(asset).document;
    std::vector<Index> node_of;
    const std::vector<Instance> all = instances_at(asset, placed_nodes(document), &node_of);
    std::vector<Matrix4> worlds;
    posed.reserve(all.size());
    Index node = no_index;
    std::shared_ptr<const RestPose> pose;
    for (std::size_t i = 0; i < all.size(); ++i) {
        const Part& part = asset.parts[all[i].part];
        // The instances of a node follow each other.
        if (node_of[i] != node) {
            node = node_of[i];
            pose =
                node == no_index ? nullptr : pose_of(source_document(asset), document["nodes"][node], worlds);
        }
        const bool is_posed = pose && ((!pose->joints.empty() && is_skinned(part)) ||
                                       (!pose->morph_weights.empty() && !part.morph_targets.empty()));
        posed.push_back({all[i].part, all[i].transform, is_posed ? pose : nullptr});
    }
    return posed;
}

}  // namespace faqem::detail
