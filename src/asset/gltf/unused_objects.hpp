#pragma once
/// \file
/// Materials and images of a glTF document that no mesh uses.

#include <string>

#include "asset/gltf/json.hpp"

namespace faqem::detail {

/// Counts the materials that no primitive has, itself, in a variant or as a coarser level of its material, and the
/// images that only these or nothing refers to. Images of image-based lights and of features and their properties are
/// in use.
/// \param document  validated
/// \return `2 materials and 1 image that no mesh uses`; empty if there are none
/// Complexity: O(size of the document)
std::string unused_objects(const Json& document);

}  // namespace faqem::detail
