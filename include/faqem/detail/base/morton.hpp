#pragma once
/// \file
/// Morton codes (Z-order curve): points with consecutive codes are close to each other in space.

#include <algorithm>
#include <cstdint>

#include "faqem/detail/base/vector.hpp"
#include "faqem/export.hpp"

FAQEM_DETAIL_BEGIN

/// Spreads the bits of x: bit i of x becomes bit 3 i of the result; all other bits are 0.
/// \param x  below 2^21
constexpr std::uint64_t spread_bits(std::uint64_t x) {
    x = (x | x << 32) & 0x001f00000000ffff;
    x = (x | x << 16) & 0x001f0000ff0000ff;
    x = (x | x << 8) & 0x100f00f00f00f00f;
    x = (x | x << 4) & 0x10c30c30c30c30c3;
    return (x | x << 2) & 0x1249249249249249;
}

/// Morton code of a point in the unit cube. In each group of three bits, x is the most significant.
/// \tparam bits  number of bits per axis, 1 to 21; the result is below 2^(3 bits)
/// \param unit   the point; coordinates outside [0, 1] are clamped, NaN counts as 0
/// O(1)
template <int bits>
std::uint64_t morton(const Vector3& unit) {
    static_assert(0 < bits && bits <= 21);
    static constexpr double last = (1 << bits) - 1;
    // The comparison is false for NaN, which is thus mapped to 0.
    const auto cell = [](double x) {
        return spread_bits(x > 0 ? static_cast<std::uint64_t>(std::min(x * last, last)) : 0);
    };
    return cell(unit.x()) << 2 | cell(unit.y()) << 1 | cell(unit.z());
}

FAQEM_DETAIL_END
