#pragma once
/// \file
/// Distributes materials over several pages where their textures have more texels than a page.

#include <cstdint>
#include <span>

#include "scene/material_groups.hpp"

namespace faqem::detail {

/// Groups materials as group_materials() does, and splits groups whose textures show more than one and a half times the
/// texels of the largest page, so that each new group shows about as many texels as a page has. Materials with the same
/// finest image stay together, since one page can show it as well as they do. An image that is repeated on the surface
/// counts once: its copies are not worth a page each.
/// \param skipped_parts  by part: whether it is not on a page; empty: all are
/// Complexity: O(faces + materials^2 + bytes of images).
MaterialGroups page_groups(const Asset& asset, const BakeOptions& bake,
                           std::span<const std::uint8_t> skipped_parts = {});

}  // namespace faqem::detail
