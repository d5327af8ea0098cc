#pragma once
/// \file
/// Whether triangles overlap in the plane, and whether a chart's boundary comes close to itself there but not on the
/// surface.

#include <cstdint>
#include <span>

#include "bake/atlas/chart.hpp"

namespace faqem::detail {

/// Whether the interiors of the triangles are pairwise disjoint. All triangles must be counter-clockwise. An
/// overlap of less than 1e-9 of the larger bounding box counts as touching, to allow for rounding.
/// Triangles are compared if their bounding boxes share a cell of a grid.
/// \param triangles  the three corners of every triangle
/// \param work       maximum number of comparisons; decreased by the number made
/// \return false also if `work` is used up before the result is known
/// Complexity: O(n) expected.
bool have_disjoint_interiors(std::span<const Triangle2> triangles, std::uint64_t& work);

/// Whether points of the boundary that are less than 1.5 texels apart on the page are about as close on the
/// surface: at most 1.5 times as far, plus half a texel. Across a slit that is narrower on the page than on
/// the surface, texture filtering would mix the texels of both sides.
/// \param all    all faces of the page
/// \param chart  without flipped or overlapping triangles
/// \param work   as in have_disjoint_interiors()
/// \return false also if `work` is used up before the result is known
/// Complexity: O(n) expected.
bool has_boundary_clearance(std::span<const PageTriangle> all, const Chart& chart, std::uint64_t& work);

}  // namespace faqem::detail
