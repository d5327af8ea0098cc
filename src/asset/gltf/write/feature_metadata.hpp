#pragma once
/// \file
/// Feature ids and their properties: EXT_mesh_features, and EXT_structural_metadata of primitives and of the document.

#include <optional>

#include "asset/gltf/write/index_extensions.hpp"
#include "asset/gltf/write/writer.hpp"

namespace faqem::detail {

inline constexpr const char* features_name = "EXT_mesh_features";
inline constexpr const char* metadata_name = "EXT_structural_metadata";

/// Keeps the feature ids of EXT_mesh_features that fit a primitive, with remapped textures: those in vertex attributes
/// that the part has, those in textures if the part has the UVs of the source, and the numbers of vertices if all are
/// those of the source. Others are left out, with a warning if any are kept.
/// \param vertices    as unchanged_vertices() gives them
/// \param extensions  of the output primitive, copied from the source
/// \return whether any are left
bool keep_feature_ids(GltfWriter& writer, const Part& part, const std::optional<VertexNumbers>& vertices,
                      Json& extensions);

/// Whether EXT_structural_metadata of a primitive fits: the part has the attributes, and for textures the UVs of the
/// source, to which it refers.
/// \param extensions  of the output primitive, copied from the source
bool fits_metadata(const GltfWriter& writer, const Part& part, const Json& extensions);

/// Replaces the buffer views and textures of EXT_structural_metadata of the document; leaves the extension out with a
/// warning if it refers to others than the document has.
/// \pre all accessors are added
void remap_structural_metadata(GltfWriter& writer);

}  // namespace faqem::detail
