#pragma once
/// \file
/// Transforms of the nodes of a glTF scene.

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "asset/gltf/json.hpp"
#include "faqem/asset.hpp"

namespace faqem::detail {

/// A node of the scene.
struct PlacedNode {
    Index node = no_index;
    std::array<double, 16> world = {};  ///< column-major matrix from the node to world space
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
std::array<double, 16> local_transform(const Json& node,
                                       const std::optional<std::array<double, 3>>& scale = {});

/// Product of column-major 4 x 4 matrices. Either may be the transform of a node or of an instance.
std::array<double, 16> product(const std::array<double, 16>& a, const std::array<double, 16>& b);

/// Lists the nodes of the default scene in depth-first order: those of the first scene if no default is set, all nodes
/// if there is no scene.
/// \param document  validated
/// \param scales    by node: scale instead of the one in the document; empty for none
/// Complexity: O(nodes)
std::vector<PlacedNode> placed_nodes(const Json& document,
                                     std::span<const std::optional<std::array<double, 3>>> scales = {});

/// The world matrix of each node of the document, also of those outside the default scene.
/// \param document  validated
/// Complexity: O(nodes)
std::vector<std::array<double, 16>> node_transforms(const Json& document);

/// Lists the instances of parts at the nodes that have meshes. Parts without a source mesh follow, with the identity
/// transform.
/// \param nodes    as placed_nodes() lists them
/// \param node_of  if not null: receives the node of each instance, no_index for parts without a source mesh
/// \pre asset.source is set
std::vector<Instance> instances_at(const Asset& asset, std::span<const PlacedNode> nodes,
                                   std::vector<Index>* node_of = nullptr);

}  // namespace faqem::detail
