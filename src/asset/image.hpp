#pragma once
/// \file
/// What kind of image some bytes are.

#include <cstdint>
#include <span>
#include <string>

namespace faqem::detail {

/// Media type by magic bytes: image/png, image/jpeg, image/webp, image/ktx2, image/vnd-ms.dds, image/gif,
/// image/bmp; empty if it is none of these.
std::string sniff_mime_type(std::span<const std::uint8_t> bytes);

/// Usual name ending with the dot, ".bin" for unknown types.
std::string file_ending(const std::string& mime_type);

}  // namespace faqem::detail
