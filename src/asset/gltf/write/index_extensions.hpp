#pragma once
/// \file
/// Extensions that refer to the vertices and triangles of a primitive by their numbers: CESIUM_primitive_outline,
/// EXT_mesh_manifold and FB_ngon_encoding. They are kept where the triangles are those of the source.

#include <optional>
#include <vector>

#include "asset/gltf/write/primitive_data.hpp"
#include "asset/gltf/write/writer.hpp"

namespace faqem::detail {

inline constexpr const char* outline_name = "CESIUM_primitive_outline";
inline constexpr const char* manifold_name = "EXT_mesh_manifold";
inline constexpr const char* ngon_name = "FB_ngon_encoding";

/// The output vertex of each vertex of a source primitive; no_index for those that no triangle uses.
using VertexNumbers = std::vector<Index>;

/// Compares an output primitive with a source primitive.
/// \param source  a primitive of the source document, or null
/// \return none unless the triangles are the same: as many, in the same order, with corners at the same positions, and
///         each vertex of one side is one vertex of the other
/// Complexity: O(vertices + corners).
std::optional<VertexNumbers> unchanged_vertices(const GltfWriter& writer, const Json& source,
                                                const PrimitiveData& data);

/// Replaces the references of the extensions of a primitive.
/// \param vertices    as unchanged_vertices() gives them
/// \param extensions  of the output primitive, copied from the source; those that refer to vertices without a number, or
///                    to no valid accessor, are left for the caller to remove
/// \return names of the extensions that fit the output
std::vector<std::string> remap_index_extensions(GltfWriter& writer, const VertexNumbers& vertices,
                                                Json& extensions);

/// Replaces the references of EXT_mesh_manifold of a mesh with one primitive.
/// \param manifold   the extension, copied from the source
/// \param corners    number of corners of the output primitive
/// \param primitive  the output primitive
/// \return false if it does not fit; it is unchanged then
bool remap_manifold(GltfWriter& writer, const VertexNumbers& vertices, std::size_t corners,
                    const Json& primitive, Json& manifold);

}  // namespace faqem::detail
