#pragma once
/// \file
/// Materials and images of a glTF document that no mesh uses.

#include <string>
#include <string_view>

#include "asset/gltf/json.hpp"

namespace faqem::detail {

/// Whether an extension names materials, textures and images by number: VRM and VRMC_*.
bool names_by_number(std::string_view extension);

/// Whether a document has or uses such an extension, so that all of these objects and their order must stay.
bool names_objects_by_number(const Json& document);

/// Counts the materials that no primitive has, itself, in a variant or as a coarser level of its material, and the
/// images that only these or nothing refers to. Images of image-based lights and of features and their properties are
/// in use; all materials and images are if names_objects_by_number().
/// \param document  validated
/// \return `2 materials and 1 image that no mesh uses`; empty if there are none
/// Complexity: O(size of the document)
std::string unused_objects(const Json& document);

}  // namespace faqem::detail
