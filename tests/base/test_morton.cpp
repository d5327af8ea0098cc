#include "faqem/detail/base/morton.hpp"

#include <limits>

#include "support/catch.hpp"

using faqem::detail::morton;
using faqem::detail::spread_bits;
using faqem::engine::Vector3;

TEST_CASE("morton: spread_bits places the bits three apart") {
    CHECK(spread_bits(0b1011) == 0b001'000'001'001);
    CHECK(spread_bits((1u << 21) - 1) == 0x1249249249249249);
}

TEST_CASE("morton: octants are ordered with x as the most significant bit") {
    std::uint64_t octant = 0;
    for (const double x : {0.2, 0.8}) {
        for (const double y : {0.2, 0.8}) {
            for (const double z : {0.2, 0.8}) CHECK(morton<1>(Vector3(x, y, z) * 1.5) == octant++);
        }
    }
}

TEST_CASE("morton: points outside the unit cube are clamped to it") {
    CHECK(morton<16>({-1, -1e300, -0.0}) == 0);
    CHECK(morton<16>({2, 1e300, 1}) == (std::uint64_t{1} << 48) - 1);
    CHECK(morton<21>({1, 1, 1}) == (std::uint64_t{1} << 63) - 1);
}

TEST_CASE("morton: NaN counts as 0") {
    const double nan = std::nan(""), infinity = std::numeric_limits<double>::infinity();
    CHECK(morton<16>({nan, -nan, -infinity}) == 0);
    CHECK(morton<16>({nan, 1, infinity}) == morton<16>({0, 1, 1}));
}
