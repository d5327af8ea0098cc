#pragma once
/// \file
/// Instances of a mesh by EXT_mesh_gpu_instancing.

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "asset/gltf/source_document.hpp"

namespace faqem::detail {

inline constexpr const char* instancing_name = "EXT_mesh_gpu_instancing";

/// Maximum number of instances in a file: many nodes may refer to the same accessors, and accessors without a view need
/// no bytes at all.
inline constexpr std::uint64_t max_instances = std::uint64_t{1} << 22;

/// The column-major matrix T * R * S, with R from a quaternion, which is normalised; zero is no rotation (glTF 2.0,
/// section 3.5.3).
std::array<double, 16> transform_matrix(const std::array<double, 3>& translation,
                                        const std::array<double, 4>& rotation,
                                        const std::array<double, 3>& scale);

/// The transforms of the instances of a node's mesh to the space of the node; empty if the node has no such extension.
/// \pre validate_gltf() passed
std::vector<std::array<double, 16>> instance_matrices(const SourceDocument& source, const Json& node);

/// Checks that all numbers of the instances are finite. This needs the buffers and is therefore separate from
/// validate_gltf().
/// \param file  path for messages
/// \throws InputError  if one is not
void check_instances(const SourceDocument& source, const std::string& file);

}  // namespace faqem::detail
