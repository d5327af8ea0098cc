#pragma once
/// \file
/// The faces on the other sides of the edges of a face.

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "faqem/detail/base/buckets.hpp"
#include "faqem/detail/base/parallel.hpp"
#include "faqem/engine/mesh/union_find.hpp"
#include "faqem/export.hpp"
#include "faqem/mesh.hpp"

FAQEM_DETAIL_BEGIN

/// Corner k of face f is 4 f + k.
using Corner = std::uint32_t;

/// Per corner of a face: the corner across the edge opposite it, if this edge has two faces, else no_index.
using Links = std::array<Corner, 3>;

namespace rounds {

inline constexpr unsigned next(unsigned k) { return k == 2 ? 0 : k + 1; }
inline constexpr unsigned previous(unsigned k) { return k == 0 ? 2 : k - 1; }

/// The corner with the smallest vertex.
inline unsigned lowest(const Triangle& t) {
    const unsigned k = t[1] < t[0] ? 1 : 0;
    return t[2] < t[k] ? 2 : k;
}

/// Whether two faces pass the edge opposite these corners of theirs in opposite directions.
inline bool have_one_winding(std::span<const Triangle> triangles, Corner a, Corner b) {
    return triangles[a >> 2][next(a & 3)] == triangles[b >> 2][previous(b & 3)];
}

/// An edge of a face, seen from its lower end.
struct Side {
    Index other;    ///< the higher end
    Corner corner;  ///< opposite the edge
};

/// Sets the links of all sides at a vertex.
inline void match_sides(std::vector<Side>& sides, std::vector<Links>& links) {
    const bool is_hub = sides.size() > 32;
    const auto is_lower = [](const Side& a, const Side& b) { return a.other < b.other; };
    if (is_hub) std::sort(sides.begin(), sides.end(), is_lower);
    for (const Side& side : sides) {
        auto at = is_hub ? std::lower_bound(sides.begin(), sides.end(), side, is_lower) : sides.begin();
        unsigned same = 0;
        Corner match = no_index;
        for (; at != sides.end() && same < 3; ++at) {
            if (at->other != side.other) {
                if (is_hub) break;
                continue;
            }
            ++same;
            if (at->corner != side.corner) match = at->corner;
        }
        links[side.corner >> 2][side.corner & 3] = same == 2 ? match : no_index;
    }
}

}  // namespace rounds

/// Finds the links of all faces. O(triangles), times a logarithm at vertices of high valence; parallel in part
/// \param triangles  with pairwise different corners
/// \param vertices   number of vertices; larger than any corner
inline std::vector<Links> link_corners(std::span<const Triangle> triangles, std::size_t vertices,
                                       const RunContext& context) {
    using namespace rounds;
    // At its lowest vertex a face has two sides, which are one entry, at the middle one the third side.
    const Buckets<Corner> entries(vertices, [&](auto&& put) {
        for (Index f = 0; f < triangles.size(); ++f) {
            const Triangle& t = triangles[f];
            const unsigned k = lowest(t);
            put(t[k], 4 * f + k);
            put(std::min(t[next(k)], t[previous(k)]), 4 * f + k);
        }
    });
    std::vector<Links> links(triangles.size());
    parallel_blocks(vertices, elements_per_block, context, [&](std::size_t first, std::size_t end) {
        std::vector<Side> sides;
        for (std::size_t v = first; v < end; ++v) {
            sides.clear();
            for (const Corner c : entries[v]) {
                const Corner face = c & ~3u;
                const unsigned k = c & 3;
                const Triangle& t = triangles[c >> 2];
                const Index a = t[next(k)], b = t[previous(k)];
                if (t[k] == v) {
                    sides.push_back({a, face | previous(k)});
                    sides.push_back({b, face | next(k)});
                } else {
                    sides.push_back({std::max(a, b), c});
                }
            }
            match_sides(sides, links);
        }
    });
    return links;
}

/// Finds the vertices of closed components: those in which every edge has two faces of opposite direction.
/// O(triangles)
/// \return one per vertex: 1 if it belongs to a closed component
inline std::vector<std::uint8_t> closed_vertices(std::span<const Triangle> triangles,
                                                 std::span<const Links> links, std::size_t vertices) {
    std::vector<std::uint8_t> closed(vertices, 1);
    std::vector<Index> open;  // faces
    for (Index f = 0; f < links.size(); ++f) {
        const auto is_closed = [&](unsigned k) {
            return links[f][k] != no_index && rounds::have_one_winding(triangles, 4 * f + k, links[f][k]);
        };
        if (!is_closed(0) || !is_closed(1) || !is_closed(2)) open.push_back(f);
    }
    if (open.empty()) return closed;
    engine::UnionFind component(vertices);
    for (const Triangle& t : triangles) component.unite(t[0], t[1]), component.unite(t[0], t[2]);
    for (const Index f : open) closed[component.find(triangles[f][0])] = 0;
    for (Index v = 0; v < vertices; ++v) closed[v] = closed[component.find(v)];  // the root comes first
    return closed;
}

FAQEM_DETAIL_END
