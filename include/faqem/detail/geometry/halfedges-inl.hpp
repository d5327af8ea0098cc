#pragma once

#include "faqem/export.hpp"
#include "faqem/detail/geometry/halfedges.hpp"

#include <algorithm>

FAQEM_NAMESPACE_BEGIN
namespace detail {

FAQEM_INLINE std::vector<Side> sorted_sides(std::span<const Triangle> triangles, engine::Poll poll) {
    std::vector<Side> sides;
    sides.reserve(3 * triangles.size());
    for (std::size_t f = 0; f < triangles.size(); ++f) {
        poll();
        const Triangle& t = triangles[f];
        if (t[0] == no_index) continue;
        for (std::uint8_t k = 0; k < 3; ++k) {
            const Index a = t[k], b = t[(k + 1) % 3];
            if (a != b) sides.push_back({std::min(a, b), std::max(a, b), static_cast<Index>(f), k, a < b});
        }
    }
    std::sort(sides.begin(), sides.end(), [poll](const Side& a, const Side& b) {
        poll();
        if (a.edge() != b.edge()) return a.edge() < b.edge();
        return a.face != b.face ? a.face < b.face : a.corner < b.corner;
    });
    return sides;
}

}  // namespace detail
FAQEM_NAMESPACE_END
