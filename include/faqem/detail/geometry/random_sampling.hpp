#pragma once
/// \file
/// Area-uniform, stratified samples of a surface that depend on their number and a seed only.

#include <cstdint>

#include "faqem/detail/geometry/surface.hpp"
#include "faqem/export.hpp"

FAQEM_NAMESPACE_BEGIN
namespace detail {

/// A point of a surface.
struct RandomSample {
    Index face = no_index;  ///< into Surface::triangles
    Vec3 barycentric = {};  ///< weights of its corners, sum 1
    Vec3 point = {};
};

/// Sample i of n: a uniform point of the face that a uniform place in the i-th of n equal slices of the area
/// falls into. O(log faces)
/// \param s     with a face
/// \param i     < n
/// \param seed  another seed, other places
FAQEM_EXPORT RandomSample sample(const Surface& s, std::uint64_t i, std::uint64_t n, std::uint64_t seed);

}  // namespace detail
FAQEM_NAMESPACE_END

#ifdef FAQEM_HEADER_ONLY
#include "faqem/detail/geometry/random_sampling-inl.hpp"
#endif
