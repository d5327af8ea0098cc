#pragma once
/// \file
/// Unsigned 32-bit integers in binary files, with the least significant byte first.

#include <cstdint>
#include <span>
#include <vector>

namespace faqem::detail {

/// The integer in the four bytes from the position `at` on.
/// \pre at + 4 <= bytes.size()
inline std::uint32_t u32_at(std::span<const std::uint8_t> bytes, std::uint64_t at) {
    return static_cast<std::uint32_t>(bytes[at]) | static_cast<std::uint32_t>(bytes[at + 1]) << 8 |
           static_cast<std::uint32_t>(bytes[at + 2]) << 16 | static_cast<std::uint32_t>(bytes[at + 3]) << 24;
}

/// Appends the four bytes of an integer.
inline void put_u32(std::vector<std::uint8_t>& bytes, std::uint32_t value) {
    for (int shift = 0; shift < 32; shift += 8) bytes.push_back(static_cast<std::uint8_t>(value >> shift));
}

}  // namespace faqem::detail
