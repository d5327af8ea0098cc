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
