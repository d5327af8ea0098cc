#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "asset/gltf/accessor.hpp"
#include "asset/gltf/scene.hpp"
#include "asset/gltf/source_document.hpp"
#include "asset/scene/affine.hpp"
#include "asset/scene/source_traits.hpp"

namespace faqem::detail {
namespace {

using NodeScales = std::vector<std::optional<Vec3>>;

// The node whose scale a channel animates, or no_index.
Index scaled_node(const Json& channel, std::size_t nodes) {
    const Json& target = member(channel, "target");
    const std::string path = string_member(target, "path");
    if (path == "scale") return index_member(target, "node");
    if (path != "pointer") return no_index;
    const std::string pointer = animated_pointer(channel);
    const Index node = pointed_node(pointer);
    // Only its own index gives the text that is compared: 01 does not.
    return node < nodes && pointer == child_path("/nodes", node) + "/scale" ? node : no_index;
}

void raise_to_keyframes(const SourceDocument& source, const Json& sampler, Vec3& scale) {
    const auto values = read_vectors<double, 3>(source, index_member(sampler, "output"));
    // A keyframe of a spline has the value between its two tangents.
    const bool is_spline = string_member(sampler, "interpolation") == "CUBICSPLINE";
    for (std::size_t i = is_spline ? 1 : 0; i < values.size(); i += is_spline ? 3 : 1) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const double value = std::abs(values[i][axis]);
            if (std::isfinite(value)) scale[axis] = std::max(scale[axis], value);
        }
    }
}

// By node: the largest scale of the nodes whose scale is animated.
NodeScales largest_scales(const SourceDocument& source) {
    const Json& nodes = member(source.document, "nodes");
    NodeScales scales(nodes.size());
    for (const Json& animation : member(source.document, "animations")) {
        for (const Json& channel : member(animation, "channels")) {
            const Index node = scaled_node(channel, nodes.size());
            if (node == no_index) continue;
            if (!scales[node]) {
                scales[node] = number_array<3>(nodes[node], "scale", {1, 1, 1});
                for (double& scale : *scales[node]) scale = std::abs(scale);
            }
            const Json& sampler = member(animation, "samplers")[unsigned_member(channel, "sampler", 0)];
            raise_to_keyframes(source, sampler, *scales[node]);
        }
    }
    return scales;
}

// By joint of a skin: the squared scale from mesh to world space; 0 for joints outside the scene.
std::vector<double> joint_scales(const SourceDocument& source, const Json& skin,
                                 const std::vector<const PlacedNode*>& node_at) {
    const Json& joints = member(skin, "joints");
    const std::vector<Matrix4> of_joint = inverse_binds(source, skin).matrices;
    std::vector<double> result;
    for (std::size_t j = 0; j < joints.size(); ++j) {
        const PlacedNode* node = node_at[joints[j].get<Index>()];
        result.push_back(node ? squared_scale(product(node->world, of_joint[j])) : 0);
    }
    return result;
}

// Root mean square of the scales of the joints, weighted by the joint weights of a mesh; nothing without weights.
std::optional<double> posed_scale(const Asset& asset, Index mesh, const std::vector<double>& of_joint) {
    double sum = 0, total = 0;
    for (const Part& part : asset.parts) {
        if (part.source != mesh) continue;
        for (std::size_t v = 0; v < part.joints.size() && v < part.weights.size(); ++v) {
            for (std::size_t k = 0; k < 4; ++k) {
                const std::size_t joint = part.joints[v][k];
                const double weight = part.weights[v][k];
                if (!(weight > 0) || joint >= of_joint.size()) continue;
                sum += weight * of_joint[joint];
                total += weight;
            }
        }
    }
    const double scale = std::sqrt(sum / total);
    return std::isfinite(scale) ? std::optional(scale) : std::nullopt;
}

}  // namespace

std::vector<Instance> seen_instances(const Asset& asset) {
    const SourceDocument& source = source_document(asset);
    const Json& document = source.document;
    std::vector<PlacedNode> nodes = placed_nodes(document, largest_scales(source));
    const std::vector<PlacedNode> unposed = nodes;
    std::vector<const PlacedNode*> node_at(array_size(document, "nodes"), nullptr);
    for (const PlacedNode& placed : unposed) node_at[placed.node] = &placed;
    for (PlacedNode& placed : nodes) {
        const Json& node = document["nodes"][placed.node];
        const Index skin = index_member(node, "skin"), mesh = index_member(node, "mesh");
        if (skin == no_index || mesh == no_index) continue;
        const std::optional<double> scale =
            posed_scale(asset, mesh, joint_scales(source, document["skins"][skin], node_at));
        if (!scale) continue;
        placed.world = identity_transform;
        for (const std::size_t diagonal : {0u, 5u, 10u}) placed.world[diagonal] = *scale;
    }
    return instances_at(asset, nodes);
}

std::vector<std::vector<InstanceMotion>> instance_motions(const Asset& asset) {
    std::vector<std::vector<InstanceMotion>> result(asset.parts.size());
    const Json& document = source_document(asset).document;
    const std::vector<std::uint8_t> is_animated = animated_nodes(document);
    const std::vector<Index> parents = parents_of(member(document, "nodes"));
    std::vector<Index> node_of;
    const std::vector<Instance> all = instances_at(asset, placed_nodes(document), &node_of);
    for (std::size_t i = 0; i < all.size(); ++i) {
        InstanceMotion& motion = result[all[i].part].emplace_back(InstanceMotion{all[i].transform});
        Index node = node_of[i];
        if (node != no_index) motion.skin = index_member(document["nodes"][node], "skin");
        while (node != no_index && !is_animated[node]) node = parents[node];
        motion.animated_node = node;
    }
    return result;
}

}  // namespace faqem::detail
