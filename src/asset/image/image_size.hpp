#pragma once
/// \file
/// What an encoded image says about its size, before any decoder takes memory for it.

#include <cstdint>
#include <optional>
#include <span>

#include "faqem/export.hpp"

namespace faqem::detail {

/// Larger images are refused.
inline constexpr std::uint64_t max_image_side = 16384;

struct ImageSize {
    std::uint64_t width = 0, height = 0;

    /// \pre both below 2^32
    std::uint64_t pixels() const { return width * height; }
};

/// The size in the header of a PNG, JPEG or WebP; nothing where there is none. O(bytes)
FAQEM_EXPORT std::optional<ImageSize> declared_size(std::span<const std::uint8_t> bytes);

/// Whether so many bytes can hold so many pixels, as far as the format tells.
///
/// A JPEG has at least one bit for each block of 8 x 8 pixels (ITU-T T.81, F and G: in its first scan a block
/// has a code). A WebP of one colour takes some 30 bytes of any size: from 4096 x 4096 pixels on, at most
/// 4096 of one byte are believed. A PNG is looked at elsewhere, when its depth is known.
/// \param bytes  the whole image
bool is_plausible_size(std::span<const std::uint8_t> bytes, const ImageSize& size);

}  // namespace faqem::detail
