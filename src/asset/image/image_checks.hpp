#pragma once
/// \file
/// Errors of encoded images, and checks of sizes and pixels. Inline, because both the asset library and the
/// image plugin, which does not link to it, use them.

#include <cstdint>
#include <string>

#include "asset/image/image_size.hpp"
#include "faqem/asset.hpp"
#include "faqem/error.hpp"

namespace faqem::detail {

/// Maximum size of the RGBA pixels of an image, in bytes.
inline constexpr std::uint64_t max_decoded_bytes = std::uint64_t{1} << 30;

/// Designation of an image in error messages, for example "image 'wood'".
inline std::string image_title(const Image& image) {
    return image.name.empty() ? "image" : "image '" + image.name + "'";
}

/// The image size in error messages, for example "640 x 480".
inline std::string image_size_text(const ImageSize& size) {
    return std::to_string(size.width) + " x " + std::to_string(size.height);
}

/// Reports an error of an image.
/// \throws InputError  always, with the file and the image
[[noreturn]] inline void fail_image(const Image& image, const std::string& what) {
    throw InputError(image.uri, image_title(image), what);
}

/// Reports that the bytes of an image cannot hold its pixels.
/// \throws InputError  always, with the file and the image
[[noreturn]] inline void fail_truncated_image(const Image& image, const ImageSize& size) {
    fail_image(image, "is damaged: " + std::to_string(image.encoded.size()) + " bytes cannot hold " +
                          image_size_text(size) + " pixels");
}

/// Checks the size of an image against the limits.
/// \throws InputError  if a side is 0 or above max_image_side, or the RGBA pixels take more than
///                     max_decoded_bytes
inline void check_image_size(const Image& image, const ImageSize& size) {
    if (size.width == 0 || size.height == 0 || size.width > max_image_side || size.height > max_image_side ||
        size.pixels() * 4 > max_decoded_bytes)
        fail_image(image, "is " + image_size_text(size) + " pixels, at most " +
                              image_size_text({max_image_side, max_image_side}) + " are supported");
}

/// Pixels of the given size, for a decoder.
/// \throws InputError  as check_image_size()
inline Pixels pixels_for(const Image& image, const ImageSize& size) {
    check_image_size(image, size);
    Pixels pixels{static_cast<std::uint32_t>(size.width), static_cast<std::uint32_t>(size.height), {}, false};
    pixels.rgba.resize(4 * size.pixels());
    return pixels;
}

/// Checks that the pixels to encode are as many as width and height say, and at least one.
/// \param name  of the image, for the message
/// \throws InputError  otherwise
inline void check_pixel_count(const Pixels& pixels, const std::string& name) {
    const std::size_t count = std::size_t{pixels.width} * pixels.height;
    if (count == 0 || pixels.rgba.size() != count * 4)
        throw InputError("", "image '" + name + "'", "its pixels do not match its width and height");
}

/// Whether the alpha of any pixel is below 255.
inline bool has_transparent_pixel(const Pixels& pixels) {
    for (std::size_t i = 3; i < pixels.rgba.size(); i += 4)
        if (pixels.rgba[i] != 255) return true;
    return false;
}

}  // namespace faqem::detail
