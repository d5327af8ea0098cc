#pragma once
/// \file
/// Numbers that look like chance and are the same everywhere.

#include <cstdint>

#include "faqem/export.hpp"

FAQEM_NAMESPACE_BEGIN
namespace engine {

/// Another 64 bits for each 64 bits: every bit depends on all of x (the finaliser of SplitMix64, Steele et
/// al. 2014). One to one; 0 stays 0. O(1)
inline std::uint64_t splitmix64(std::uint64_t x) {
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
    return x ^ (x >> 31);
}

}  // namespace engine
FAQEM_NAMESPACE_END
