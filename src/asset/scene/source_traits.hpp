#pragma once
/// \file
/// What the file of an asset tells beside parts, materials and images: variants, animations, and how exactly numbers are
/// stored. Assets without Asset::source have none of these.

#include <array>
#include <cstdint>
#include <tuple>
#include <vector>

#include "faqem/asset.hpp"
#include "faqem/export.hpp"

namespace faqem::detail {

/// True if the scene has animations, or parts with skins or morph targets. O(parts)
FAQEM_EXPORT bool is_dynamic(const Asset& asset);

/// The materials that the variants of a part show: indices into Asset::materials, each once, ascending, without those
/// that the asset does not have. Complexity: O(variants * materials).
FAQEM_EXPORT std::vector<Index> variant_materials(const Asset& asset, const Part& part);

/// By material of an asset: nonzero if an animation moves a texture of its source. O(animation channels * materials)
FAQEM_EXPORT std::vector<std::uint8_t> materials_with_moving_textures(const Asset& asset);

/// By part: nonzero if something would lose its meaning with new UVs and images: material variants, or an animation of a
/// texture of one of its materials.
/// Complexity: O(faces + variants * materials + animation channels * materials).
FAQEM_EXPORT std::vector<std::uint8_t> parts_that_need_uvs(const Asset& asset);

/// Distances of the values that neighbouring integers of a file stand for; 0 for floats.
struct MotionSteps {
    double weight = 0;  ///< of the weight of a joint
    std::vector<double>
        shift;  ///< by morph target of the part: of a component of a displacement, model units
};

/// The largest steps of the joint weights and displacements of a part. O(primitives * morph targets)
FAQEM_EXPORT MotionSteps motion_steps(const Asset& asset, const Part& part);

/// Lists the instances as instances(), with transforms for the measurement of sizes:
/// * A node whose scale is animated has the largest scale per axis of its own and of all keyframes.
/// * The node of a skinned mesh does not place it. The transform is a uniform scaling instead: the root mean square of
///   the scales of the joints, from mesh to world space, weighted by the joint weights of all vertices.
/// Complexity: O(nodes + keyframes + vertices)
FAQEM_EXPORT std::vector<Instance> seen_instances(const Asset& asset);

/// What places and moves an instance. Instances for which it is equal keep their places to each other.
struct InstanceMotion {
    std::array<double, 16> transform;  ///< Instance::transform
    Index skin = no_index;             ///< in the source document
    Index animated_node = no_index;    ///< the node, or the nearest one above it, that an animation moves

    bool operator<(const InstanceMotion& other) const {
        return std::tie(transform, skin, animated_node) <
               std::tie(other.transform, other.skin, other.animated_node);
    }
};

/// By part: the motions of its instances, in the order of the scene. O(nodes * depth + channels + instances)
FAQEM_EXPORT std::vector<std::vector<InstanceMotion>> instance_motions(const Asset& asset);

}  // namespace faqem::detail
