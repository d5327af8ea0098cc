#pragma once
/// \file
/// Deterministic hash (SplitMix64), the same on all platforms.

#include <cstdint>

#include "faqem/export.hpp"

FAQEM_ENGINE_BEGIN

/// Mixes the bits of x: each bit of the result depends on all bits of x (finaliser of SplitMix64, Steele et
/// al. 2014). One-to-one; maps 0 to 0. O(1)
inline std::uint64_t splitmix64(std::uint64_t x) {
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
    return x ^ (x >> 31);
}

FAQEM_ENGINE_END
