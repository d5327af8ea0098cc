#pragma once
/// \file
/// The size that the header of an encoded image declares, read before a decoder allocates memory.

#include <cstdint>
#include <optional>

#include "faqem/asset.hpp"
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

}  // namespace faqem::detail
