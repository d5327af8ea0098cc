#pragma once
/// \file
/// Makes the material of a page from its images.

#include <array>
#include <cstdint>
#include <optional>
#include <span>

#include "bake/page/page_request.hpp"
#include "bake/source/extension_layers.hpp"
#include "bake/texture/pending_images.hpp"
#include "scene/material_groups.hpp"

namespace faqem::detail {

/// The value of an image of which all texels are equal.
/// \param pixels  the image; may be empty
/// \param known   by texel: nonzero if the texel shows a triangle; the others do not count
/// \return R, G, B and A in 0 to 255, for each channel whose known texels differ by at most 1 the mean of the
///     least and the largest value; nothing for the other channels, or if no texel is known
/// Complexity: O(texels).
std::array<std::optional<float>, 4> constant_channels(const Pixels& pixels,
                                                      std::span<const std::uint8_t> known);

/// Whether all known texels of a normal map are the unperturbed normal, up to 1 of 255 per channel.
bool is_flat_normal_map(const Pixels& pixels, std::span<const std::uint8_t> known);

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
