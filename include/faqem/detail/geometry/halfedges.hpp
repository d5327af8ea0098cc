#pragma once
/// \file
/// The halfedges of triangles, sorted so that those on one edge lie together.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "faqem/engine/util/cancellation.hpp"
#include "faqem/export.hpp"
#include "faqem/mesh.hpp"

FAQEM_NAMESPACE_BEGIN
namespace detail {

/// A halfedge of a face.
struct Halfedge {
    Index low = no_index, high = no_index;  ///< its ends
    Index face = no_index;
    std::uint8_t corner = 0;    ///< of the face, where the halfedge begins: 0, 1 or 2
    bool is_ascending = false;  ///< from `low` to `high`

    std::uint64_t edge() const { return std::uint64_t{low} << 32 | high; }
};

/// All halfedges of all triangles by low end, high end, face and corner. Triangles with no_index corners are
/// none, and halfedges with equal ends are left out. O(n log n)
/// \throws what the poll throws
std::vector<Halfedge> sorted_halfedges(std::span<const Triangle> triangles,
                                       engine::CancellationCheck check_cancelled = {});

/// Calls visit(std::span<const Halfedge>) for the halfedges on each edge.
/// \param halfedges  sorted.
/// O(n)
template <class Visit>
void for_each_edge(std::span<const Halfedge> halfedges, Visit&& visit) {
    for (std::size_t begin = 0, end; begin < halfedges.size(); begin = end) {
        for (end = begin + 1; end < halfedges.size() && halfedges[end].edge() == halfedges[begin].edge();)
            ++end;
        visit(halfedges.subspan(begin, end - begin));
    }
}

/// Calls join(i, j), i < j, for the halfedges on one edge that carry a surface on across it: two where there are
/// no others; where three or more meet, those of a surface that has exactly two of them.
/// \param count  of halfedges on the edge
/// \param surface  of halfedge i < count: any number that tells surfaces apart
/// O(count log count)
template <class SurfaceId, class Join>
void for_each_connected_pair(std::size_t count, SurfaceId&& surface, Join&& join) {
    if (count == 2) join(std::size_t{0}, std::size_t{1});
    if (count < 3) return;
    std::vector<std::pair<std::uint64_t, std::size_t>> halfedges;
    for (std::size_t i = 0; i < count; ++i) halfedges.emplace_back(surface(i), i);
    std::sort(halfedges.begin(), halfedges.end());
    for (std::size_t begin = 0, end; begin < count; begin = end) {
        for (end = begin + 1; end < count && halfedges[end].first == halfedges[begin].first;) ++end;
        if (end - begin == 2) join(halfedges[begin].second, halfedges[begin + 1].second);
    }
}

}  // namespace detail
FAQEM_NAMESPACE_END

#ifdef FAQEM_HEADER_ONLY
#include "faqem/detail/geometry/halfedges-inl.hpp"
#endif
