#pragma once
/// \file
/// Order of triangles and vertices for graphics hardware, which keeps recently transformed vertices in a small
/// cache and reads vertices in blocks.

#include <vector>

#include "faqem/mesh.hpp"

namespace faqem::detail {

/// Sorts triangles so that those that share vertices follow each other, then vertices in the order of their
/// first use. Without meshoptimizer (FAQEM_WITH_MESHOPT) nothing is changed.
///
/// Of the orders of meshoptimizer, meshopt_optimizeVertexCache has the fewest cache misses with a FIFO of 12 to
/// 32 entries. Its scores are sums of constants, so the result does not depend on the machine.
/// \param vertices  any values, each used by a corner; permuted
/// \param corners   indices into `vertices`, three per triangle; the order within a triangle stays
/// Complexity: O(corners) for bounded valence.
void order_for_gpu(std::vector<Index>& vertices, std::vector<Index>& corners);

}  // namespace faqem::detail
