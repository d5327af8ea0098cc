#pragma once
/// \file
/// Poses of the meshes of a glTF scene.

#include <array>
#include <cstdint>
#include <vector>

#include "asset/gltf/source_document.hpp"
#include "asset/scene/rest_pose.hpp"
#include "faqem/asset.hpp"

namespace faqem::detail {

/// The matrices of a skin from the space of the mesh to that of each joint.
struct InverseBinds {
    std::vector<std::array<double, 16>> matrices;  ///< one per joint, column-major
    std::uint64_t repaired = 0;  ///< number of matrices that were not finite and are the identity instead
};

/// Reads the inverse bind matrices of a skin; the identity for joints without one, and if they are no MAT4 of floats.
/// \pre validate_gltf() and check_sparse() passed
InverseBinds inverse_binds(const SourceDocument& source, const Json& skin);

/// Lists the instances of gltf_instances() with their poses. A skin poses the parts that have joint weights, wherever
/// its joints are, and replaces the transform of the node. Morph weights are those of the node, else of the mesh;
/// numbers only. Skins of nodes with EXT_mesh_gpu_instancing are ignored.
/// \pre asset.source is set
std::vector<PosedInstance> gltf_posed_instances(const Asset& asset);

}  // namespace faqem::detail
