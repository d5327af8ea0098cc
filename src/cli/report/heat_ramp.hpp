#pragma once
/// \file
/// Colours for how large an error is: from dark blue to yellow, in steps that are even for the eye.

#include <array>
#include <cstdint>

#include "faqem/mesh.hpp"

namespace faqem::cli {

/// sRGB. Every eighth of viridis, by van der Walt and Smith, which is in the public domain.
inline constexpr std::array<std::array<std::uint8_t, 3>, 9> heat_ramp = {{{68, 1, 84},
                                                                          {71, 45, 123},
                                                                          {59, 82, 139},
                                                                          {44, 114, 142},
                                                                          {33, 144, 140},
                                                                          {39, 173, 129},
                                                                          {93, 200, 99},
                                                                          {170, 220, 50},
                                                                          {253, 231, 37}}};

/// \param share  of the ramp; below 0 and not a number: 0, above 1: 1
/// \return linear RGBA
Vec4f heat_colour(double share);

}  // namespace faqem::cli
