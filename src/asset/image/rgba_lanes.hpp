#pragma once
/// \file
/// RGBA values in vector registers. Eigen's arrays are made in memory, from which a register cannot be loaded as long as the
/// four values are not stored.

#include <bit>
#include <cstdint>
#include <cstring>

namespace faqem::detail {

using RgbaLanes [[gnu::vector_size(16)]] = float;
using IntegerLanes [[gnu::vector_size(16)]] = std::int32_t;
using ShortLanes [[gnu::vector_size(16)]] = std::uint16_t;

static_assert(std::endian::native == std::endian::little);  // each half is extended by zeros above it

/// The first four of eight integers.
inline RgbaLanes to_lanes(ShortLanes integers) {
    const auto extended = __builtin_shufflevector(integers, ShortLanes{}, 0, 8, 1, 9, 2, 10, 3, 11);
    return __builtin_convertvector(reinterpret_cast<IntegerLanes>(extended), RgbaLanes);
}

/// Four integers from memory.
inline RgbaLanes to_lanes(const std::uint16_t* rgba) {
    using LongLanes [[gnu::vector_size(16)]] = std::int64_t;
    std::int64_t shorts = 0;
    std::memcpy(&shorts, rgba, sizeof shorts);
    return to_lanes(reinterpret_cast<ShortLanes>(LongLanes{shorts}));
}

inline RgbaLanes to_lanes(const std::uint8_t* rgba) {
    using Bytes [[gnu::vector_size(16)]] = std::uint8_t;
    std::int32_t bytes = 0;
    std::memcpy(&bytes, rgba, sizeof bytes);
    const auto extended = __builtin_shufflevector(reinterpret_cast<Bytes>(IntegerLanes{bytes}), Bytes{}, 0,
                                                  16, 1, 17, 2, 18, 3, 19, 4, 20, 5, 21, 6, 22, 7, 23);
    return to_lanes(reinterpret_cast<ShortLanes>(extended));
}

}  // namespace faqem::detail
