#include "asset/gltf/pose.hpp"

#include <algorithm>
#include <cstring>
#include <memory>

#include "asset/gltf/accessor.hpp"
#include "asset/gltf/json.hpp"
#include "asset/gltf/scene.hpp"
#include "asset/scene/affine.hpp"
#include "asset/scene/repair.hpp"

namespace faqem::detail {
namespace {

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

/// Reads the poses of nodes; the matrices of the nodes are computed once, when a skin needs them.
class PoseReader {
public:
    explicit PoseReader(const SourceDocument& source) : source_(source) {}

    /// The pose of the mesh at a node; null if nothing deforms it.
    std::shared_ptr<const RestPose> read(const Json& node) {
        RestPose pose;
        pose.morph_weights = default_morph_weights(source_.document, node);
        const Index skin = index_member(node, "skin");
        const bool has_instances = member(node, "extensions").contains(instancing_name);
        if (skin != no_index && !has_instances) pose.joints = joint_matrices(source_.document["skins"][skin]);
        if (pose.joints.empty() && pose.morph_weights.empty()) return nullptr;
        return std::make_shared<const RestPose>(std::move(pose));
    }

private:
    std::vector<std::array<double, 16>> joint_matrices(const Json& skin) {
        if (worlds_.empty()) worlds_ = node_transforms(source_.document);
        std::vector<std::array<double, 16>> matrices = inverse_binds(source_, skin).matrices;
        const Json& joints = member(skin, "joints");
        for (std::size_t j = 0; j < matrices.size(); ++j)
            matrices[j] = product(worlds_[joints[j].get<Index>()], matrices[j]);
        return matrices;
    }

    const SourceDocument& source_;
    std::vector<std::array<double, 16>> worlds_;
};

}  // namespace

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

std::vector<PosedInstance> gltf_posed_instances(const Asset& asset) {
    const Json& document = asset.source->document;
    std::vector<Index> node_of;
    const std::vector<Instance> all = instances_at(asset, placed_nodes(document), &node_of);
    PoseReader reader(*asset.source);
    std::vector<PosedInstance> posed;
    posed.reserve(all.size());
    Index node = no_index;
    std::shared_ptr<const RestPose> pose;
    for (std::size_t i = 0; i < all.size(); ++i) {
        const Part& part = asset.parts[all[i].part];
        // The instances of a node follow each other.
        if (node_of[i] != node) {
            node = node_of[i];
            pose = node == no_index ? nullptr : reader.read(document["nodes"][node]);
        }
        const bool is_posed = pose && ((!pose->joints.empty() && is_skinned(part)) ||
                                       (!pose->morph_weights.empty() && !part.morph_targets.empty()));
        posed.push_back({all[i].part, all[i].transform, is_posed ? pose : nullptr});
    }
    return posed;
}

}  // namespace faqem::detail
