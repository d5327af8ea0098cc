#pragma once
/// \file
/// Whether flat triangles lie on each other.

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>

#include "bake/atlas/chart.hpp"
#include "faqem/engine/util/cancellation.hpp"

namespace faqem::detail {

/// Whether the triangles' insides are apart from each other. All must turn counter-clockwise. What overlaps
/// by less than 1e-9 of the larger box counts as touching: that is rounding.
/// Triangles are compared where their boxes share a cell of a grid. Expected O(n).
/// \param work  comparisons to make at most; lowered by those made
/// \return false too if the work is used up before it is known
/// \throws what the poll throws
bool have_disjoint_interiors(std::span<const std::array<ChartPoint, 3>> triangles, std::uint64_t& work,
                             engine::CancellationCheck check_cancelled = {});

}  // namespace faqem::detail
