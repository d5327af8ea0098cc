#pragma once
/// \file
/// List of half-edges, sorted so that those on the same edge are contiguous.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "faqem/export.hpp"
#include "faqem/mesh.hpp"

FAQEM_DETAIL_BEGIN

/// A half-edge of a face.
struct Halfedge {
    Index low = no_index, high = no_index;  ///< its vertices, low < high
    Index face = no_index;
    std::uint8_t corner = 0;    ///< corner of the face at which the half-edge starts: 0, 1 or 2
    bool is_ascending = false;  ///< true if the half-edge leads from `low` to `high`

    /// Key of the undirected edge.
    std::uint64_t edge() const { return std::uint64_t{low} << 32 | high; }
    /// The corner of the face that is not on the edge.
    std::uint8_t opposite() const { return static_cast<std::uint8_t>((corner + 2) % 3); }
};

/// Lists the half-edges of all triangles, sorted by low vertex, high vertex, face and corner.
/// \param triangles  triangles with no_index as first corner are skipped, and so are half-edges with two
///                   equal vertices
/// O(n log n)
FAQEM_EXPORT std::vector<Halfedge> sorted_halfedges(std::span<const Triangle> triangles);

/// Calls visit(std::span<const Halfedge>) once for each edge, with all half-edges on it.
/// \param halfedges  as returned by sorted_halfedges()
/// O(n)
template <class Visit>
void for_each_edge(std::span<const Halfedge> halfedges, Visit&& visit) {
    for (std::size_t begin = 0, end; begin < halfedges.size(); begin = end) {
        for (end = begin + 1; end < halfedges.size() && halfedges[end].edge() == halfedges[begin].edge();)
            ++end;
        visit(halfedges.subspan(begin, end - begin));
    }
}

/// Calls join(i, j), i < j, for the pairs of half-edges on one edge across which a surface is connected. If
/// the edge has exactly two half-edges, these form the pair. If it has more (a non-manifold edge), the
/// half-edges of each surface that has exactly two of them form a pair.
/// \param count    number of half-edges on the edge
/// \param surface  std::uint64_t(std::size_t i), i < count: identifies the surface of half-edge i
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

FAQEM_DETAIL_END

#ifdef FAQEM_HEADER_ONLY
#include "faqem/detail/geometry/halfedges-inl.hpp"
#endif
