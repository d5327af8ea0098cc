#pragma once
/// \file
/// Encoding of PNG files.

#include <string>

#include "faqem/asset.hpp"
#include "faqem/export.hpp"

namespace faqem::detail {

/// Encodes pixels as a PNG with 8 bits per sample, as grey or RGB, with alpha or without, or as palette indices:
/// the smallest of those that hold the pixels. Each row has the filter whose result has the least sum of
/// absolute values (W3C PNG specification, "Filter selection").
/// \param pixels  of the declared size, at least one. If Pixels::has_alpha is false, alpha is not written
/// \param name    Image::name of the result
/// \param max_difference  in [0, 127]: by how much a colour value may change, so that filtered values are multiples of
///                        2 max_difference + 1 and compress better. Alpha does not change. This is the near-lossless
///                        mode of JPEG-LS (ISO/IEC 14495-1, A.4.4), with the filters as predictors
/// O(pixels)
FAQEM_EXPORT Image write_png(const Pixels& pixels, const std::string& name, int max_difference = 0);

}  // namespace faqem::detail
