#pragma once
/// \file
/// The size that the header of an encoded image declares, read before a decoder allocates memory.

#include <cstdint>
#include <optional>
#include <span>

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

/// Reads the size from the header of a PNG, JPEG or WebP; empty if there is none. O(bytes)
FAQEM_EXPORT std::optional<ImageSize> declared_size(std::span<const std::uint8_t> bytes);

/// Returns an upper estimate, in bytes, of the memory of a decoder in addition to the RGBA pixels that it
/// returns, from the headers of a PNG, JPEG or WebP; 0 if the image will be rejected. O(bytes)
FAQEM_EXPORT std::uint64_t decoding_memory(std::span<const std::uint8_t> bytes);

/// Whether an encoded image of this length can hold this number of pixels.
///
/// A JPEG has at least one bit per block of 8 x 8 pixels, since every block has a code in the first scan
/// (ITU-T T.81, annexes F and G). A WebP of a single colour takes about 30 bytes at any size; therefore
/// images above 4096 x 4096 pixels are limited to 4096 pixels per byte. PNG images are always accepted here;
/// they are checked when their bit depth is known.
/// \param bytes  the whole encoded image
/// \param size   the size in its header
bool is_plausible_size(std::span<const std::uint8_t> bytes, const ImageSize& size);

}  // namespace faqem::detail
