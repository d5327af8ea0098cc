#pragma once
/// \file
/// Makes the material of a page from its images.

#include <span>

#include "bake/page/page_request.hpp"
#include "bake/source/extension_layers.hpp"
#include "bake/texture/pending_images.hpp"
#include "scene/material_groups.hpp"

namespace faqem::detail {

/// Returns the material of a group, and adds the page's images to the result, to be encoded. A channel with an
/// image has factor 1, and one that is constant on the page has this value as factor and no image; other
/// channels keep the factors of the group's first material.
/// \param channels  the channels of `images`
/// \param layers    extension layers of the group's material; their factors are kept
/// \param out       receives the images
Material page_material(const Asset& source, const BakeOptions& bake, const MaterialGroup& group,
                       const Channels& channels, std::span<const ExtensionLayer> layers, PageImages images,
                       UnencodedResult& out);

}  // namespace faqem::detail
