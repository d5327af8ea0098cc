#pragma once
/// \file
/// The sides of triangles, sorted so that those on one edge lie together.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "faqem/mesh.hpp"

namespace faqem::detail {

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
std::vector<Side> sorted_sides(std::span<const Triangle> triangles);

/// Calls visit(std::span<const Side>) for the sides on each edge. \param sides  sorted. O(n)
template <class Visit>
void for_each_edge(std::span<const Side> sides, Visit&& visit) {
    for (std::size_t begin = 0, end; begin < sides.size(); begin = end) {
        for (end = begin + 1; end < sides.size() && sides[end].edge() == sides[begin].edge();) ++end;
        visit(sides.subspan(begin, end - begin));
    }
}

}  // namespace faqem::detail
