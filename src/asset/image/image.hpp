#pragma once
/// \file
/// What kind of image some bytes are, and what is in them.

#include <cstdint>
#include <span>
#include <string>

#include "faqem/asset.hpp"
#include "faqem/engine/util/cancellation.hpp"
#include "faqem/export.hpp"

namespace faqem::detail {

/// The public functions of these names, which poll. \throws what the poll throws, too
FAQEM_EXPORT Pixels decode(const Image& image, engine::CancellationCheck check_cancelled);
FAQEM_EXPORT Image encode_png(const Pixels& pixels, const std::string& name,
                              engine::CancellationCheck check_cancelled);
FAQEM_EXPORT Image encode_jpeg(const Pixels& pixels, const std::string& name, std::uint32_t quality,
                               Content content, engine::CancellationCheck check_cancelled);

/// Media type by magic bytes: image/png, image/jpeg, image/webp, image/ktx2, image/vnd-ms.dds, image/gif,
/// image/bmp; empty if it is none of these.
std::string sniff_mime_type(std::span<const std::uint8_t> bytes);

/// Whether decode() knows the media type: PNG and JPEG, and WebP where OpenImageIO reads it from memory.
bool can_decode_image(const std::string& mime_type);

/// "PNG, JPEG and WebP", or what else can be decoded, for errors.
std::string decodable_format_names();

/// Usual name ending with the dot, ".bin" for unknown types.
std::string file_extension(const std::string& mime_type);

}  // namespace faqem::detail
