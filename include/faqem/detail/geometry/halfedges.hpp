#pragma once
/// \file
/// The sides of triangles, sorted so that those on one edge lie together.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "faqem/export.hpp"
#include "faqem/engine/util/cancellation.hpp"
#include "faqem/mesh.hpp"

FAQEM_NAMESPACE_BEGIN
namespace detail {

/// A side of a face.
struct Side {
    Index low = no_index, high = no_index;  ///< its ends
    Index face = no_index;
    std::uint8_t corner = 0;  ///< of the face, where the side begins: 0, 1 or 2
    bool goes_up = false;     ///< from `low` to `high`

    std::uint64_t edge() const { return std::uint64_t{low} << 32 | high; }
};

/// All sides of all triangles by low end, high end, face and corner. Triangles with no_index corners are
/// none, and sides with equal ends are left out. O(n log n)
/// \throws what the poll throws
std::vector<Side> sorted_sides(std::span<const Triangle> triangles, engine::Poll poll = {});

/// Calls visit(std::span<const Side>) for the sides on each edge.
/// \param sides  sorted.
/// O(n)
template <class Visit>
void for_each_edge(std::span<const Side> sides, Visit&& visit) {
    for (std::size_t begin = 0, end; begin < sides.size(); begin = end) {
        for (end = begin + 1; end < sides.size() && sides[end].edge() == sides[begin].edge();) ++end;
        visit(sides.subspan(begin, end - begin));
    }
}

/// Calls join(i, j), i < j, for the sides on one edge that carry a surface on across it: two where there are
/// no others; where three or more meet, those of a surface that has exactly two of them.
/// \param count  of sides on the edge
/// \param surface  of side i < count: any number that tells surfaces apart
/// O(count log count)
template <class Surface, class Join>
void for_each_pair(std::size_t count, Surface&& surface, Join&& join) {
    if (count == 2) join(std::size_t{0}, std::size_t{1});
    if (count < 3) return;
    std::vector<std::pair<std::uint64_t, std::size_t>> sides;
    for (std::size_t i = 0; i < count; ++i) sides.emplace_back(surface(i), i);
    std::sort(sides.begin(), sides.end());
    for (std::size_t begin = 0, end; begin < count; begin = end) {
        for (end = begin + 1; end < count && sides[end].first == sides[begin].first;) ++end;
        if (end - begin == 2) join(sides[begin].second, sides[begin + 1].second);
    }
}

}  // namespace detail
FAQEM_NAMESPACE_END

#ifdef FAQEM_HEADER_ONLY
#include "faqem/detail/geometry/halfedges-inl.hpp"
#endif
