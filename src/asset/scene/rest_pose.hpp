#pragma once
/// \file
/// Instances as a viewer shows them at rest: posed by their joints, with their default morph weights.

#include <memory>
#include <vector>

#include "asset/scene/affine.hpp"
#include "faqem/asset.hpp"

namespace faqem::detail {

/// What deforms an instance.
struct RestPose {
    /// By joint of the skin: the column-major matrix from part to world space. Empty for parts without a skin.
    std::vector<Matrix4> joints;
    /// By morph target, in any range; those beyond the end are 0.
    std::vector<double> morph_weights;
};

/// An instance with its pose.
struct PosedInstance {
    Index part = no_index;   ///< index into Asset::parts
    Matrix4 transform = {};  ///< Instance::transform; vertices with joint weights ignore it
    std::shared_ptr<const RestPose> pose = nullptr;  ///< null for instances that the transform alone places
};

/// Lists the instances in the order of instances(), with their poses. A skin poses the parts that have joint weights,
/// wherever its joints are, and replaces the transform of the node. Morph weights are those of the node, else of the mesh;
/// numbers only. Instances of EXT_mesh_gpu_instancing have no skin. Complexity: O(nodes + instances).
FAQEM_EXPORT std::vector<PosedInstance> posed_instances(const Asset& asset);

/// The part in world space, in its pose: each position is displaced by the morph targets and then multiplied by the sum
/// of the joint matrices times the joint weights, which are scaled to the sum 1 (glTF 2.0, sections 3.7.2.2 and
/// 3.7.3.3). Normals are transformed in the same way, by the inverse transpose, and normalised. The transform of the
/// instance places vertices without joint weights. The winding of faces whose corners are mirrored is reversed.
/// Tangents, joints and morph targets are left out. Joints that the skin does not have are ignored.
/// \pre instance.pose is set
/// Complexity: O(size of the part).
FAQEM_EXPORT Part posed_part(const Part& part, const PosedInstance& instance);

/// An upper bound of the absolute coordinates of posed_part() and of its intermediate results; infinite or NaN if they
/// may be outside the range of double.
/// \param largest  largest absolute coordinate of the part
/// \pre instance.pose is set
double posed_coordinate_bound(const Part& part, double largest, const PosedInstance& instance);

}  // namespace faqem::detail
