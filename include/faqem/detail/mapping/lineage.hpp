#pragma once
/// \file
/// From the small surface to the original by the paper's heuristic.

#include <vector>

#include "faqem/detail/mapping/replay.hpp"
#include "faqem/export.hpp"
#include "faqem/history.hpp"
#include "faqem/surface_map.hpp"

FAQEM_NAMESPACE_BEGIN
namespace detail {

/// FA-QEM, "Successive Mapping Process": a point belongs to the closest corner of its small face, goes at
/// every un-collapse to the closer of the two parents, and ends at a vertex of the original.
class LineageMap {
public:
    /// \throws what the poll throws
    explicit LineageMap(const CollapseHistory& history, engine::CancellationCheck check_cancelled = {});

    /// The answer is a face at the vertex, one of the small face's material group where there is one, then
    /// the smallest index, with weight 1 at the vertex.
    SurfacePoint map(Index face, const Vec3& barycentric) const;

private:
    const CollapseHistory& history_;
    ReplayTables replay_;
    std::vector<std::uint64_t> first_face_;  ///< per original vertex: its range in faces_
    std::vector<Index> faces_;               ///< by vertex, ascending
};

}  // namespace detail
FAQEM_NAMESPACE_END

#ifdef FAQEM_HEADER_ONLY
#include "faqem/detail/mapping/lineage-inl.hpp"
#endif
