#pragma once
/// \file
/// Detection of image formats.

#include <cstdint>
#include <span>
#include <string>

#include "faqem/asset.hpp"

namespace faqem::detail {

/// Detects the media type from the magic bytes: image/png, image/jpeg, image/webp, image/ktx2,
/// image/vnd-ms.dds, image/gif or image/bmp; empty if the format is unknown.
FAQEM_EXPORT std::string sniff_mime_type(std::span<const std::uint8_t> bytes);

/// Whether decode() supports the media type, which is that of PNG, JPEG or WebP.
bool can_decode_image(const std::string& mime_type);

/// Names of the formats that decode() supports, for error messages.
inline constexpr const char* decodable_format_names = "PNG, JPEG and WebP";

/// Usual file name extension of a media type, including the dot; ".bin" for unknown types.
std::string file_extension(const std::string& mime_type);

}  // namespace faqem::detail
