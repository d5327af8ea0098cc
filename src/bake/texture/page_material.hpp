#pragma once
/// \file
/// Makes the material of a page from its images.

#include <span>

#include "bake/texture/bake_job.hpp"
#include "bake/texture/page_baker.hpp"

namespace faqem::detail {

/// Returns the material of a group, and adds the page's images to the result, to be encoded. A channel with an
/// image has factor 1, and one that is constant on the page has this value as factor and no image; other
/// channels keep the factors of the group's first material.
/// \param channels  the channels of `images`
/// \param layers    extension layers of the group's material; their factors are kept
Material page_material(BakeJob& job, const MaterialGroup& group, const Channels& channels,
                       std::span<const ExtensionLayer> layers, PageImages images);

}  // namespace faqem::detail
