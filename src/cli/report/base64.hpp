#pragma once
/// \file
/// Base64 encoding.

#include <cstdint>
#include <span>
#include <string>

namespace faqem::cli {

/// Returns the Base64 encoding of bytes, with padding (RFC 4648, section 4).
std::string base64(std::span<const std::uint8_t> bytes);

}  // namespace faqem::cli
