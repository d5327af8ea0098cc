#pragma once
/// \file
/// Transforms of the nodes of a glTF scene, of the instances of their meshes by EXT_mesh_gpu_instancing, and poses of the
/// meshes.

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "asset/gltf/source_document.hpp"
#include "asset/scene/rest_pose.hpp"

namespace faqem::detail {

inline constexpr const char* instancing_name = "EXT_mesh_gpu_instancing";

/// Maximum number of instances in a file: many nodes may refer to the same accessors, and accessors without a view need
/// no bytes at all.
inline constexpr std::uint64_t max_instances = std::uint64_t{1} << 22;

/// The column-major matrix T * R * S, with R from a quaternion, which is normalised; zero is no rotation (glTF 2.0,
/// section 3.5.3).
Matrix4 transform_matrix(const Vec3& translation, const std::array<double, 4>& rotation, const Vec3& scale);

/// The transforms of the instances of a node's mesh to the space of the node; empty if the node has no such extension.
/// \pre parse_gltf() passed
std::vector<Matrix4> instance_matrices(const SourceDocument& source, const Json& node);

/// Checks that all numbers of the instances are finite. This needs the buffers and is therefore separate from
/// parse_gltf().
/// \param file  path for messages
/// \throws InputError  if one is not
void check_instances(const SourceDocument& source, const std::string& file);

/// A node of the scene.
struct PlacedNode {
    Index node = no_index;
    Matrix4 world = {};  ///< column-major matrix from the node to world space
};

/// The numbers of the array object[key]; `values` if there is none.
/// \pre the document was validated
template <std::size_t N>
std::array<double, N> number_array(const Json& object, const char* key, std::array<double, N> values) {
    const Json& array = member(object, key);
    for (std::size_t i = 0; i < N && i < array.size(); ++i) values[i] = array[i].get<double>();
    return values;
}

/// The column-major matrix from a node to its parent.
/// \param scale  instead of that of the node
Matrix4 local_transform(const Json& node, const std::optional<Vec3>& scale = {});

/// Product of column-major 4 x 4 matrices. Either may be the transform of a node or of an instance.
Matrix4 product(const Matrix4& a, const Matrix4& b);

/// By node: its parent, or no_index.
std::vector<Index> parents_of(const Json& nodes);

/// Lists the nodes of the default scene in depth-first order: those of the first scene if no default is set, all nodes
/// if there is no scene.
/// \param document  validated
/// \param scales    by node: scale instead of the one in the document; empty for none
/// Complexity: O(nodes)
std::vector<PlacedNode> placed_nodes(const Json& document, std::span<const std::optional<Vec3>> scales = {});

/// The world matrix of each node of the document, also of those outside the default scene.
/// \param document  validated
/// Complexity: O(nodes)
std::vector<Matrix4> node_transforms(const Json& document);

/// Lists the instances of parts at the nodes that have meshes. Those of EXT_mesh_gpu_instancing follow each other. Parts
/// without a source mesh follow, with the identity transform.
/// \param nodes    as placed_nodes() lists them
/// \param node_of  if not null: receives the node of each instance, no_index for parts without a source mesh
std::vector<Instance> instances_at(const Asset& asset, std::span<const PlacedNode> nodes,
                                   std::vector<Index>* node_of = nullptr);

/// By node: whether an animation targets it or one of its members.
/// O(nodes + channels)
std::vector<std::uint8_t> animated_nodes(const Json& document);

/// The matrices of a skin from the space of the mesh to that of each joint.
struct InverseBinds {
    std::vector<Matrix4> matrices;  ///< one per joint, column-major
    std::uint64_t repaired = 0;     ///< number of matrices that were not finite and are the identity instead
};

/// Reads the inverse bind matrices of a skin; the identity for joints without one, and if they are no MAT4 of floats.
/// \pre parse_gltf() and check_sparse() passed
InverseBinds inverse_binds(const SourceDocument& source, const Json& skin);

}  // namespace faqem::detail
