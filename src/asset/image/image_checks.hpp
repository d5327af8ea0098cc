#pragma once
/// \file
/// Errors of encoded images, and checks of the image size.

#include <string>

#include "asset/image/image_size.hpp"
#include "faqem/asset.hpp"

namespace faqem::detail {

/// Designation of an image in error messages, for example "image 'wood'".
std::string image_title(const Image& image);

/// Reports an error of an image.
/// \throws InputError  always, with the file and the image
[[noreturn]] void fail_image(const Image& image, const std::string& what);

/// Reports that the bytes of an image cannot hold its pixels.
/// \throws InputError  always, with the file and the image
[[noreturn]] void fail_truncated_image(const Image& image, const ImageSize& size);

/// Checks the size of an image against the limits.
/// \throws InputError  if a side is 0 or above max_image_side, or the RGBA pixels take more than 1 GiB
void check_image_size(const Image& image, const ImageSize& size);

}  // namespace faqem::detail
