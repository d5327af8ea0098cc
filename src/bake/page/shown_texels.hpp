#pragma once
/// \file
/// Texels of a page that its triangles show.

#include <cstdint>
#include <vector>

#include "bake/atlas/per_triangle.hpp"

namespace faqem::detail {

/// By texel of a page: nonzero if its centre is in a triangle, or if the centre of a triangle is in it. The
/// gutter is not among them: it is read at the edges of triangles only, with small weights.
/// Complexity: O(texels + triangles).
std::vector<std::uint8_t> shown_texels(const Atlas& atlas);

}  // namespace faqem::detail
