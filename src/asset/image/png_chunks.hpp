#pragma once
/// \file
/// Removal of metadata from PNG files before they are decoded.

#include <cstdint>
#include <span>
#include <vector>

namespace faqem::detail {

/// Returns a PNG without the chunks that do not affect its pixels: texts, Exif data, suggested palettes and
/// private chunks. libpng expands a compressed text to up to 8 MB and stores up to 1000 of them.
/// \param png  bytes that begin with the signature of PNG. Everything after a damaged chunk is kept; the
///             decoder reports it
/// \return empty if there are no such chunks
/// O(size)
std::vector<std::uint8_t> without_metadata(std::span<const std::uint8_t> png);

}  // namespace faqem::detail
