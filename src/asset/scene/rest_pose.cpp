#include "asset/scene/rest_pose.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>

#include "asset/scene/part_arrays.hpp"

namespace faqem::detail {
namespace {

/// Adds the displacements of the morph targets, times their weights.
void apply_morph_weights(const Part& part, const std::vector<double>& weights, Part& posed) {
    const auto displace = [](const auto& displacements, double weight, auto& values) {
        using Number = typename std::decay_t<decltype(values)>::value_type::value_type;
        for (std::size_t v = 0; v < values.size() && v < displacements.size(); ++v)
            for (std::size_t k = 0; k < 3; ++k)
                values[v][k] = static_cast<Number>(values[v][k] + weight * displacements[v][k]);
    };
    for (std::size_t m = 0; m < part.morph_targets.size() && m < weights.size(); ++m) {
        if (weights[m] == 0) continue;
        displace(part.morph_targets[m].positions, weights[m], posed.positions);
        displace(part.morph_targets[m].normals, weights[m], posed.normals);
    }
}

/// The sum of the matrices of a vertex, in the order of the joints, so that vertices which list the same joints in
/// another order stay together. None for vertices without weights.
std::optional<Matrix4> blended_matrix(const std::vector<Matrix4>& matrices,
                                      const std::array<std::uint16_t, 4>& joints, const Vec4f& weights) {
    std::array<std::pair<std::uint16_t, double>, 4> influences;
    for (std::size_t k = 0; k < 4; ++k) {
        const bool is_used = weights[k] > 0 && joints[k] < matrices.size();
        influences[k] = {joints[k], is_used ? static_cast<double>(weights[k]) : 0};
    }
    std::ranges::sort(influences);
    double sum = 0;
    for (const auto& [joint, weight] : influences) sum += weight;
    if (!(sum > 0 && std::isfinite(sum))) return std::nullopt;
    Matrix4 blended = {};
    for (const auto& [joint, weight] : influences) {
        if (weight == 0) continue;
        for (std::size_t i = 0; i < blended.size(); ++i) blended[i] += weight / sum * matrices[joint][i];
    }
    return blended;
}

}  // namespace

Part posed_part(const Part& part, const PosedInstance& instance) {
    Part posed;
    posed.name = part.name;
    posed.positions = part.positions;
    posed.triangles = part.triangles;
    posed.normals = part.normals;
    posed.uvs = part.uvs;
    posed.colors = part.colors;
    for (const FaceArray& array : face_arrays) {
        posed.*array.values = part.*array.values;
        if (array.names) posed.*array.names = part.*array.names;
    }
    const RestPose& pose = *instance.pose;
    apply_morph_weights(part, pose.morph_weights, posed);
    const bool is_skinned = !pose.joints.empty() && part.joints.size() == part.positions.size() &&
                            part.weights.size() == part.positions.size();
    const NormalTransform of_instance(instance.transform);
    std::vector<std::uint8_t> is_mirrored(posed.positions.size(), of_instance.is_mirrored());
    for (std::size_t v = 0; v < posed.positions.size(); ++v) {
        const std::optional<Matrix4> joints =
            is_skinned ? blended_matrix(pose.joints, part.joints[v], part.weights[v]) : std::nullopt;
        posed.positions[v] = transformed_point(joints ? *joints : instance.transform, posed.positions[v]);
        const NormalTransform normals = joints ? NormalTransform(*joints) : of_instance;
        is_mirrored[v] = normals.is_mirrored();
        if (!posed.normals.empty()) posed.normals[v] = normals(posed.normals[v]);
    }
    for (Triangle& t : posed.triangles)
        if (is_mirrored[t[0]] + is_mirrored[t[1]] + is_mirrored[t[2]] >= 2) std::swap(t[1], t[2]);
    return posed;
}

double posed_coordinate_bound(const Part& part, double largest, const PosedInstance& instance) {
    const RestPose& pose = *instance.pose;
    for (std::size_t m = 0; m < part.morph_targets.size() && m < pose.morph_weights.size(); ++m)
        largest += std::abs(pose.morph_weights[m]) * largest_component(part.morph_targets[m].positions);
    // Points between those of two joints are in the box of both.
    double bound = transformed_bound(instance.transform, largest);
    for (const Matrix4& joint : pose.joints) bound = max_or_nan(bound, transformed_bound(joint, largest));
    return bound;
}

}  // namespace faqem::detail
