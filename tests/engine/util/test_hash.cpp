#include "faqem/engine/util/hash.hpp"

#include <bit>

#include "support/catch.hpp"

using faqem::engine::splitmix64;

TEST_CASE("splitmix64: reproduces the published output of the SplitMix64 generator") {
    // The first three outputs for seed 1234567, as published with the generator.
    std::uint64_t state = 1234567;
    const auto next = [&] { return splitmix64(state += 0x9e3779b97f4a7c15u); };
    CHECK(next() == 6457827717110365317u);
    CHECK(next() == 3203168211198807973u);
    CHECK(next() == 9817491932198370423u);
}

TEST_CASE("splitmix64: flipping one input bit changes about half of the output bits") {
    int changed = 0;
    for (int bit = 0; bit < 64; ++bit) {
        changed += std::popcount(splitmix64(12345) ^ splitmix64(12345 ^ (std::uint64_t{1} << bit)));
    }
    CHECK(changed > 64 * 28);
    CHECK(changed < 64 * 36);
}
