#pragma once
/// \file
/// Area-uniform, stratified pseudorandom samples of a surface. Each sample depends on its index, the
/// number of samples and the seed only, so that samples can be computed in any order and on any thread.

#include <cstdint>

#include "faqem/detail/geometry/surface.hpp"
#include "faqem/export.hpp"

FAQEM_DETAIL_BEGIN

/// A sample point of a surface.
struct RandomSample {
    Index face = no_index;  ///< index into Surface::triangles
    Vec3 barycentric = {};  ///< barycentric coordinates in the face; >= 0, sum 1
    Vec3 point = {};        ///< position
};

/// Computes sample i of n. The faces, in order, are divided into n strata of equal area; a uniform random
/// position in stratum i selects the face, and the sample is uniformly distributed over that face.
/// \param s     has at least one face
/// \param i     index of the sample, < n
/// \param n     number of samples
/// \param seed  different seeds give different samples
/// O(log faces)
FAQEM_EXPORT RandomSample sample(const Surface& s, std::uint64_t i, std::uint64_t n, std::uint64_t seed);

FAQEM_DETAIL_END

#ifdef FAQEM_HEADER_ONLY
#include "faqem/detail/geometry/random_sampling-inl.hpp"
#endif
