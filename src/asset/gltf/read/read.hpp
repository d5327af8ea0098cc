#pragma once
/// \file
/// From tinygltf's model to parts and materials.

#include "asset/gltf/load.hpp"

namespace faqem::detail {

/// Joins the triangle primitives of a mesh to one part; points and lines stay in the source.
/// \param dropped_faces  is increased by the faces left out for a position that is not finite
/// \throws InputError  an index is out of range
Part read_part(LoadedGltf& loaded, Index mesh, std::uint64_t& dropped_faces);

/// All materials; TextureRef::image is an index into the document's images.
std::vector<Material> read_materials(LoadedGltf& loaded);

}  // namespace faqem::detail
