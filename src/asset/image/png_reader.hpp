#pragma once
/// \file
/// Decoding of PNG files.

#include "faqem/asset.hpp"

namespace faqem::detail {

/// Decodes a PNG of any colour type and bit depth to 8-bit RGBA. Samples of 16 bits are rounded to the nearest
/// value of 8 bits; gamma, colour profiles and other metadata are skipped.
/// \param image  its declared size has been checked
/// \throws InputError  the image is damaged, or too short for its pixels; the latter is found before memory is
///                     allocated
/// O(pixels + bytes)
Pixels read_png(const Image& image);

}  // namespace faqem::detail
