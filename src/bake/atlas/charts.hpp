#pragma once
/// \file
/// The charts of a page: regions laid flat, split where that fails, and joined where it does not.

#include <cstdint>
#include <span>
#include <vector>

#include "bake/atlas/chart.hpp"
#include "faqem/detail/base/parallel.hpp"

namespace faqem::detail {

/// What becomes of faces.
struct Charts {
    std::vector<Chart> charts;  ///< by smallest face; every face is in one
    std::uint64_t faces_over_work_limit =
        0;  ///< faces that lie alone because the work for their region was used up
};

/// Charts with a mean stretch of `max_stretch` at most, no longer than 0.9 of the side of a square page that
/// they would all just fill. Regions (see cluster_faces()) are laid flat; one that cannot be is split: faces
/// that would lie on their backs leave it, or else it is cut in two. Then charts are joined over their
/// longest common borders as long as the whole can be laid flat.
/// Every region, and the joining, may use so much work only; what is not done then lies face by face, or
/// stays apart. Independent of the number of threads.
/// O(n log n) expected, and O(n) flattenings of a face at most
/// \throws what the poll of the workers throws
Charts make_charts(std::span<const ChartFace> faces, Workers workers);

}  // namespace faqem::detail
