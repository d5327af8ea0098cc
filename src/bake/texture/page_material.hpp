#pragma once
/// \file
/// From the images of a page to its material.

#include <span>

#include "bake/texture/bake_job.hpp"
#include "bake/texture/page.hpp"

namespace faqem::detail {

/// The material of a group, with the page's images added to the result, encoded as the options say. A channel
/// with an image has factor 1; the others keep what the group's first material says.
/// \param channels  those that `images` has
/// \param layers    of the group's material; their factors stay
Material page_material(BakeJob& job, const MaterialGroup& group, const Channels& channels,
                       std::span<const ExtensionLayer> layers, const PageImages& images);

}  // namespace faqem::detail
