#pragma once
/// \file
/// Whether a chart's boundary comes close to itself on the page but not on the surface.

#include <cstdint>
#include <span>

#include "bake/atlas/chart.hpp"

namespace faqem::detail {

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
