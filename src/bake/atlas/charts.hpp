#pragma once
/// \file
/// Chart generation: faces are segmented into regions, and the regions are parametrized, split and merged.

#include <cstdint>
#include <span>
#include <vector>

#include "bake/atlas/chart.hpp"
#include "faqem/detail/base/parallel.hpp"

namespace faqem::detail {

/// Result of make_charts().
struct Charts {
    std::vector<Chart> charts;  ///< sorted by smallest face; every face is in exactly one chart
    /// Faces that became charts of their own because the work limit of their region was reached.
    std::uint64_t faces_over_work_limit = 0;
};

/// Divides faces into charts with a mean stretch (Chart::stretch) of at most 1.06 and a bounding box diagonal
/// of at most 0.9 times the side of a square page that all charts together would exactly fill.
/// The regions of cluster_faces() are parametrized. A region without an acceptable parametrization is split:
/// flipped faces are separated from it if they are at most a quarter of its faces, otherwise it is bisected.
/// Then neighbouring charts are merged where their union has an acceptable parametrization, those that share
/// the largest part of a perimeter first.
/// Every region and the merging have a work limit. When it is reached, the remaining faces of the region
/// become charts of their own, and the remaining charts are not merged.
/// The result does not depend on the number of threads.
/// Complexity: O(n log n) expected, plus O(n) flattenings of a face.
Charts make_charts(std::span<const PageTriangle> faces, const RunContext& context);

}  // namespace faqem::detail
