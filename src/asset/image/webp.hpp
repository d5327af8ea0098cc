#pragma once
/// \file
/// Decoding and encoding of WebP files.

#include <string>

#include "faqem/asset.hpp"

namespace faqem::detail {

/// Decodes a WebP to RGBA; of an animation the first picture.
/// \param image  its declared size has been checked
/// \throws InputError  the image is damaged
/// O(pixels + bytes)
Pixels read_webp(const Image& image);

/// Encodes pixels as WebP. Colours under an alpha of 0 are kept, because filtered textures show them; only
/// WebpMode::near_lossless loses them.
/// \param pixels  of the declared size, at least one. If Pixels::has_alpha is false, alpha is not written
/// \param name    Image::name of the result
/// \throws OptionError  an option is out of range
/// \throws WriteError   a side is longer than 16383 pixels, the limit of the format
/// O(pixels)
Image write_webp(const Pixels& pixels, const std::string& name, const WebpOptions& options);

}  // namespace faqem::detail
