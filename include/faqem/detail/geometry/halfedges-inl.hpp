#pragma once

#include "faqem/detail/geometry/halfedges.hpp"

FAQEM_DETAIL_BEGIN

FAQEM_INLINE std::vector<Halfedge> sorted_halfedges(std::span<const Triangle> triangles) {
    std::vector<Halfedge> halfedges;
    halfedges.reserve(3 * triangles.size());
    for (std::size_t f = 0; f < triangles.size(); ++f) {
        const Triangle& t = triangles[f];
        if (t[0] == no_index) continue;
        for (std::uint8_t k = 0; k < 3; ++k) {
            const Index a = t[k], b = t[(k + 1) % 3];
            if (a != b)
                halfedges.push_back({std::min(a, b), std::max(a, b), static_cast<Index>(f), k, a < b});
        }
    }
    std::sort(halfedges.begin(), halfedges.end(), [](const Halfedge& a, const Halfedge& b) {
        if (a.edge() != b.edge()) return a.edge() < b.edge();
        return a.face != b.face ? a.face < b.face : a.corner < b.corner;
    });
    return halfedges;
}

FAQEM_DETAIL_END
