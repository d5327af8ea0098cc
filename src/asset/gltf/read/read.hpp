#pragma once
/// \file
/// Conversion of a loaded document to parts and materials.

#include "asset/gltf/read/load.hpp"

namespace faqem::detail {

/// Joins the triangle primitives of a mesh to one part. Points and lines remain in the source document only.
/// \param loaded         the document; warnings are added to it
/// \param mesh           index of the mesh
/// \param dropped_faces  increased by the number of faces left out because of a non-finite position
/// \throws InputError  if an index is out of range or there are too many vertices
Part read_part(LoadedGltf& loaded, Index mesh, std::uint64_t& dropped_faces);

/// Sets Asset::normal_bits and uv_bits to their defaults if vertices of the document are integers.
/// \param loaded  the document
/// \param asset   has the parts
void read_vertex_bits(const LoadedGltf& loaded, Asset& asset);

/// Reads all materials. TextureRef::image is an index into the images of the document.
/// \param loaded  the document; warnings are added to it
std::vector<Material> read_materials(LoadedGltf& loaded);

}  // namespace faqem::detail
