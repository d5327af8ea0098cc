#pragma once
/// \file
/// The perceptually uniform colour map of heat maps, from dark blue to yellow.

#include <array>
#include <cstdint>

#include "faqem/mesh.hpp"

namespace faqem::cli {

/// Samples of the colour map viridis (van der Walt and Smith, public domain) at multiples of 1/8. sRGB, 0 to
/// 255.
inline constexpr std::array<std::array<std::uint8_t, 3>, 9> heat_ramp = {{{68, 1, 84},
                                                                          {71, 45, 123},
                                                                          {59, 82, 139},
                                                                          {44, 114, 142},
                                                                          {33, 144, 140},
                                                                          {39, 173, 129},
                                                                          {93, 200, 99},
                                                                          {170, 220, 50},
                                                                          {253, 231, 37}}};

/// Returns the interpolated colour at a position of the colour map.
/// \param share  position in [0, 1]; clamped, NaN is treated as 0
/// \return linear RGBA
Vec4f heat_color(double share);

}  // namespace faqem::cli
