#pragma once
/// \file
/// Map from the simplified mesh to the vertices of the original, by the heuristic of the FA-QEM paper.

#include <vector>

#include "faqem/detail/mapping/replay.hpp"
#include "faqem/export.hpp"
#include "faqem/history.hpp"
#include "faqem/surface_map.hpp"

FAQEM_NAMESPACE_BEGIN
namespace detail {

/// Maps a point to a vertex of the original: starts with the closest corner of its simplified face, undoes
/// the collapses that created this vertex, and each time continues with the closer of the two merged
/// vertices.
/// Source: FA-QEM, "Successive Mapping Process"
class LineageMap {
public:
    /// \param history  valid; must outlive this object
    /// O(size of the history)
    explicit LineageMap(const CollapseHistory& history);

    /// Maps one point. The result is at a vertex, in one of its faces: preferably a face of the same group as
    /// the simplified face, and of these the one with the smallest index.
    /// \param face         face of the simplified mesh
    /// \param barycentric  weights of its three corners, >= 0, sum 1
    /// O(number of collapses undone)
    SurfacePoint map(Index face, const Vec3& barycentric) const;

    /// Same as map(); the result for a nearby point is of no use.
    SurfacePoint map_near(Index face, const Vec3& barycentric, const SurfacePoint&) const {
        return map(face, barycentric);
    }

private:
    const CollapseHistory& history_;
    ReplayTables replay_;
    std::vector<std::uint64_t> first_face_;  ///< per original vertex: beginning of its range in faces_
    std::vector<Index> faces_;               ///< faces of each vertex, in ascending order
};

}  // namespace detail
FAQEM_NAMESPACE_END

#ifdef FAQEM_HEADER_ONLY
#include "faqem/detail/mapping/lineage-inl.hpp"
#endif
