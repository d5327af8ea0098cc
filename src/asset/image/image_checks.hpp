#pragma once
/// \file
/// What is wrong with an encoded image, as far as its size tells.

#include <string>

#include "asset/image/image_size.hpp"
#include "faqem/asset.hpp"

namespace faqem::detail {

/// "image 'wood'", for messages.
std::string image_title(const Image& image);

/// \throws InputError, always: names file and image
[[noreturn]] void fail_image(const Image& image, const std::string& what);

/// \throws InputError as one whose bytes cannot hold its pixels, always
[[noreturn]] void fail_truncated_image(const Image& image, const ImageSize& size);

/// \throws InputError if a side is 0 or above max_image_side, or the pixels would take more than 1 GiB
void check_image_size(const Image& image, const ImageSize& size);

}  // namespace faqem::detail
