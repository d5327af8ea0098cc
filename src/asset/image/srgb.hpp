#pragma once
/// \file
/// The sRGB transfer function (IEC 61966-2-1). Values outside 0..1 follow the same branches.

#include <cmath>

namespace faqem::detail {

/// Converts an sRGB value to linear light.
inline double linear_from_srgb(double c) {
    return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
}

/// Converts linear light to an sRGB value.
inline double srgb_from_linear(double c) {
    return c <= 0.0031308 ? c * 12.92 : 1.055 * std::pow(c, 1 / 2.4) - 0.055;
}

}  // namespace faqem::detail
