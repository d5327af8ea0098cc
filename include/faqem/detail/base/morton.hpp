#pragma once
/// \file
/// A curve through space along which neighbours are near each other.

#include <algorithm>
#include <cstdint>

#include "faqem/engine/mesh/vector.hpp"
#include "faqem/export.hpp"

FAQEM_NAMESPACE_BEGIN
namespace detail {

/// Every third bit of the result is one of x, from the lowest on. \param x  below 2^21
constexpr std::uint64_t spread_bits(std::uint64_t x) {
    x = (x | x << 32) & 0x001f00000000ffff;
    x = (x | x << 16) & 0x001f0000ff0000ff;
    x = (x | x << 8) & 0x100f00f00f00f00f;
    x = (x | x << 4) & 0x10c30c30c30c30c3;
    return (x | x << 2) & 0x1249249249249249;
}

/// Where a point is on the Morton curve through the unit cube; points outside are drawn to its sides.
/// \tparam bits  per axis, at most 21: the result is below 2^(3 bits)
template <int bits>
std::uint64_t morton(const engine::Vector3& unit) {
    static_assert(0 < bits && bits <= 21);
    static constexpr double last = (1 << bits) - 1;
    // What is no number is where 0 is.
    const auto cell = [](double x) {
        return spread_bits(x > 0 ? static_cast<std::uint64_t>(std::min(x * last, last)) : 0);
    };
    return cell(unit.x()) << 2 | cell(unit.y()) << 1 | cell(unit.z());
}

}  // namespace detail
FAQEM_NAMESPACE_END
