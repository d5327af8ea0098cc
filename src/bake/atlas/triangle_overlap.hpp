#pragma once
/// \file
/// Overlap test for triangles in the plane.

#include <cstdint>
#include <span>

#include "bake/atlas/point2.hpp"

namespace faqem::detail {

/// Whether the interiors of the triangles are pairwise disjoint. All triangles must be counter-clockwise. An
/// overlap of less than 1e-9 of the larger bounding box counts as touching, to allow for rounding.
/// Triangles are compared if their bounding boxes share a cell of a grid.
/// \param triangles  the three corners of every triangle
/// \param work       maximum number of comparisons; decreased by the number made
/// \return false also if `work` is used up before the result is known
/// Complexity: O(n) expected.
bool have_disjoint_interiors(std::span<const Triangle2> triangles, std::uint64_t& work);

}  // namespace faqem::detail
