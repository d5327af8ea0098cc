#pragma once
/// \file
/// Detection of image formats.

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "faqem/asset.hpp"

namespace faqem::detail {

/// Detects the media type from the magic bytes: image/png, image/jpeg, image/webp, image/ktx2, image/avif,
/// image/vnd-ms.dds, image/gif, image/bmp or image/tiff; empty if the format is unknown.
std::string sniff_mime_type(std::span<const std::uint8_t> bytes);

/// What a file is that begins with the text, for example "an HTML page"; null if it may be a model or another image.
const char* foreign_kind(std::string_view text);

/// Why the bytes are no image of any kind, for example "is no image: it begins like an HTML page"; empty if they may
/// be one, perhaps damaged.
std::string no_image_reason(std::span<const std::uint8_t> bytes);

/// Media type of TGA, which has no magic bytes: Image::mime_type says what it is.
inline constexpr const char* tga_media_type = "image/x-tga";

/// Media type of an image: from the magic bytes or, for TGA, as declared (also image/tga); empty if it is unknown.
FAQEM_EXPORT std::string media_type(const Image& image);

/// Whether decode() uses the plugin: for TGA, BMP, TIFF and GIF. glTF cannot hold such images.
bool needs_plugin(const Image& image);

inline constexpr const char* ktx2_media_type = "image/ktx2";

/// Whether an image is of a kind that decode() does not know (AVIF, DDS ..., KTX2 without its plugin): it stays as it is.
FAQEM_EXPORT bool is_passed_through(const Image& image);

/// Whether an image stays as it is wherever its UVs are kept: those that are passed through, and all of KTX2, which are
/// made for the memory of GPUs.
FAQEM_EXPORT bool keeps_encoding(const Image& image);

/// Whether glTF images of the media type, which is that of PNG, JPEG, WebP or, with its plugin, KTX2, are read.
bool can_decode_image(const std::string& mime_type);

/// Usual file name extension of a media type, including the dot; ".bin" for unknown types.
std::string file_extension(const std::string& mime_type);

}  // namespace faqem::detail
