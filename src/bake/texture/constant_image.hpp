#pragma once
/// \file
/// Baked images with one value, which a material stores as a factor.

#include <array>
#include <cstdint>
#include <optional>
#include <span>

#include "faqem/asset.hpp"

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

}  // namespace faqem::detail
