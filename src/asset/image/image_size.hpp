#pragma once
/// \file
/// The size that the header of an encoded image declares, read before a decoder allocates memory, and errors of encoded
/// images. The checks are inline, because both the asset library and the image plugin, which does not link to it, use
/// them.

#include <cstdint>
#include <optional>
#include <string>

#include "faqem/asset.hpp"
#include "faqem/error.hpp"
#include "faqem/export.hpp"

namespace faqem::detail {

/// Maximum width and height of an image, in pixels.
inline constexpr std::uint64_t max_image_side = 16384;

/// Width and height in pixels.
struct ImageSize {
    std::uint64_t width = 0, height = 0;

    /// Number of pixels.
    /// \pre width and height are below 2^32
    std::uint64_t pixels() const { return width * height; }
};

/// Reads the size from the header of an image of a kind that decode() reads; empty if there is none. Of a TIFF
/// the size of the first picture, of a GIF that of the whole animation. O(bytes)
FAQEM_EXPORT std::optional<ImageSize> declared_size(const Image& image);

/// Number of pixels that the header of an image declares; 0 if it declares none, or more per side than are read. O(bytes)
FAQEM_EXPORT std::uint64_t readable_pixels(const Image& image);

/// Returns an upper estimate, in bytes, of the memory of a decoder in addition to the RGBA pixels that it
/// returns, from the header of the image; 0 if the image will be rejected. O(bytes)
FAQEM_EXPORT std::uint64_t decoding_memory(const Image& image);

/// Whether an encoded image of this length can hold this number of pixels.
///
/// A JPEG has at least one bit per block of 8 x 8 pixels, since every block has a code in the first scan (ITU-T
/// T.81, annexes F and G). A WebP of a single colour takes about 30 bytes at any size; therefore images above
/// 4096 x 4096 pixels are limited to 4096 pixels per byte, as are GIF (a code of 12 bits stands for less than
/// 4096 pixels) and TIFF (deflate expands at most 1032 times). TGA packs at most 128 pixels into two bytes, BMP
/// 255. PNG images are always accepted here; they are checked when their bit depth is known.
/// \param image  the encoded image
/// \param size   the size in its header
bool is_plausible_size(const Image& image, const ImageSize& size);

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
