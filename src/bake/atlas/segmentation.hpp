#pragma once
/// \file
/// Which faces may become a chart: regions that look one way.

#include <span>
#include <vector>

#include "bake/atlas/chart.hpp"
#include "faqem/engine/util/cancellation.hpp"

namespace faqem::detail {

/// Groups of faces, each connected over `adjacent`. Neighbouring regions are joined again and again, the pair
/// first that adds least to the spread of its normals (face areas times squared distance from the mean
/// normal; Ward's rule, as in the face clusters of Garland et al. 2001) and to its outline's square. None is
/// made whose mean normal is shorter than 1 - `max_normal_spread`, or whose densities differ by more than 2.
/// \return by region, faces ascending; regions by smallest face.
/// O(n log n) expected
/// \throws what the poll throws
std::vector<std::vector<Index>> cluster_faces(std::span<const ChartFace> faces,
                                              engine::CancellationCheck check_cancelled = {});

/// The connected groups of `faces`.
/// \param faces  ascending
/// \return each ascending, by smallest face
std::vector<std::vector<Index>> connected_subsets(std::span<const ChartFace> all,
                                                  std::span<const Index> faces);

/// Two connected groups of about the same number of faces, grown breadth first from two faces far apart.
/// \param faces  connected, two at least, ascending
std::array<std::vector<Index>, 2> bisect(std::span<const ChartFace> all, std::span<const Index> faces);

}  // namespace faqem::detail
