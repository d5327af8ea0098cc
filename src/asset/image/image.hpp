#pragma once
/// \file
/// Detection of image formats, and decoding and encoding with cancellation.

#include <cstdint>
#include <span>
#include <string>

#include "faqem/asset.hpp"
#include "faqem/engine/util/cancellation.hpp"
#include "faqem/export.hpp"

namespace faqem::detail {

/// Same as the public functions of these names, with a cancellation check.
/// \throws Cancelled  if `check_cancelled` requests it; other exceptions of `check_cancelled` are passed on
FAQEM_EXPORT Pixels decode(const Image& image, engine::CancellationCheck check_cancelled);
FAQEM_EXPORT Image encode_png(const Pixels& pixels, const std::string& name,
                              engine::CancellationCheck check_cancelled);
FAQEM_EXPORT Image encode_jpeg(const Pixels& pixels, const std::string& name, std::uint32_t quality,
                               Content content, engine::CancellationCheck check_cancelled);

/// Detects the media type from the magic bytes: image/png, image/jpeg, image/webp, image/ktx2,
/// image/vnd-ms.dds, image/gif or image/bmp; empty if the format is unknown.
FAQEM_EXPORT std::string sniff_mime_type(std::span<const std::uint8_t> bytes);

/// Whether decode() supports the media type: PNG and JPEG, for which the image codec is not loaded, and WebP
/// if the codec can read it.
bool can_decode_image(const std::string& mime_type);

/// Names of the formats that decode() supports, for error messages: "PNG, JPEG and WebP" or "PNG and JPEG".
std::string decodable_format_names();

/// Usual file name extension of a media type, including the dot; ".bin" for unknown types.
std::string file_extension(const std::string& mime_type);

}  // namespace faqem::detail
