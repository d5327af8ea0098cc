#pragma once
/// \file
/// The sRGB transfer function (IEC 61966-2-1). Values outside 0..1 follow the same branches. Colours that were stored as
/// numbers from 0 to 255.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <initializer_list>
#include <string>
#include <vector>

#include "faqem/mesh.hpp"

namespace faqem::detail {

/// Converts an sRGB value to linear light.
inline double linear_from_srgb(double c) {
    return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
}

/// Converts linear light to an sRGB value.
inline double srgb_from_linear(double c) {
    return c <= 0.0031308 ? c * 12.92 : 1.055 * std::pow(c, 1 / 2.4) - 0.055;
}

/// Divides colours by 255, with a warning, if they were stored as numbers from 0 to 255. Numbers up to 2 are from 0 to
/// 1, possibly overexposed.
/// \param largest   number of a colour up to 255, as stored
/// \param colors    linear, as if the numbers were from 0 to 1
/// \param warnings  receives the warning
inline void divide_byte_colors(double largest, std::initializer_list<std::vector<Vec4f>*> colors,
                               std::vector<std::string>& warnings) {
    constexpr double largest_unit_color = 2;
    if (!(largest > largest_unit_color)) return;
    warnings.push_back("colours stored as numbers up to " +
                       std::to_string(static_cast<int>(std::ceil(largest))) + " are divided by 255");
    for (std::vector<Vec4f>* const list : colors) {
        for (Vec4f& c : *list) {
            for (std::size_t k = 0; k < 3; ++k)
                c[k] = static_cast<float>(linear_from_srgb(srgb_from_linear(c[k]) / 255));
            c[3] = std::min(c[3] / 255, 1.0f);
        }
    }
}

}  // namespace faqem::detail
