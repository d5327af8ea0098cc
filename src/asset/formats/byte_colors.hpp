#pragma once
/// \file
/// Colours that were stored as numbers from 0 to 255.

#include <initializer_list>
#include <string>
#include <vector>

#include "faqem/asset.hpp"

namespace faqem::detail {

/// Divides colours by 255, with a warning, if they were stored as numbers from 0 to 255. Numbers up to 2 are from 0 to
/// 1, possibly overexposed.
/// \param largest   number of a colour up to 255, as stored
/// \param colors    linear, as if the numbers were from 0 to 1
/// \param warnings  receives the warning
void divide_byte_colors(double largest, std::initializer_list<std::vector<Vec4f>*> colors,
                        std::vector<std::string>& warnings);

}  // namespace faqem::detail
