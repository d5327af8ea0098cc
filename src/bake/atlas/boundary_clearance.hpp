#pragma once
/// \file
/// Whether a chart's outline comes close to itself.

#include <cstdint>
#include <span>

#include "bake/atlas/chart.hpp"
#include "faqem/engine/util/cancellation.hpp"

namespace faqem::detail {

/// Whether places of the outline that are less than 1.5 texels from each other on the page are about as near
/// on the surface: half as far again, and half a texel, at most. Across a slit that is narrower than its wedge
/// on the surface, viewers would mix texels of both sides.
/// \param all   of the page
/// \param work  as in apart()
/// \return false too if the work is used up before it is known
/// \throws what the poll throws
/// Expected O(n).
bool has_boundary_clearance(std::span<const ChartFace> all, const Chart& chart, std::uint64_t& work,
                            engine::CancellationCheck check_cancelled = {});

}  // namespace faqem::detail
