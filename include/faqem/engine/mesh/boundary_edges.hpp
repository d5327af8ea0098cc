#pragma once
/// \file
/// The open edges of a surface, and those that a collapse would leave.

#include <algorithm>
#include <array>
#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

#include "faqem/export.hpp"
#include "faqem/engine/mesh/triangle_soup.hpp"
#include "faqem/engine/mesh/pair_table.hpp"

FAQEM_NAMESPACE_BEGIN
namespace engine {

/// An edge with one face, from the vertex that a pair (u, v) would become.
struct OpenEdge {
    Index vertex;                  ///< its other end
    std::uint32_t with_u, with_v;  ///< faces that the other end has with u and with v until then
};

namespace open_edges {

inline std::uint32_t faces_of_edge(const Complex& complex, const PairTable& pairs, Index v, Index other) {
    std::uint32_t count = 0;
    const auto [few, many] = complex.by_degree(v, other);
    pairs.for_each_pair(few, [&, end = many](Neighbour n) {
        if (n.vertex == end) count = pairs.face_count(n.pair);
    });
    return count;
}

}  // namespace open_edges

/// The edges with one face, each by its smaller end first, in order.
/// \param triangles  of different corners
/// \param vertices   more than any corner
/// \throws what the poll throws
/// O(triangles) for bounded valence; 12 bytes per triangle
inline std::vector<std::array<Index, 2>> find_open_edges(std::span<const Triangle> triangles,
                                                         std::size_t vertices, Poll poll = {}) {
    std::vector<std::size_t> place(vertices + 1, 0);
    const auto for_each_edge = [&](auto&& visit) {
        for (const Triangle& t : triangles) {
            poll();
            for (std::size_t k = 0; k < 3; ++k) {
                const Index a = t[k], b = t[(k + 1) % 3];
                visit(std::min(a, b), std::max(a, b));
            }
        }
    };
    for_each_edge([&](Index a, Index) { ++place[a + 1]; });
    std::partial_sum(place.begin(), place.end(), place.begin());
    std::vector<Index> larger(place.back());
    for_each_edge([&](Index a, Index b) { larger[place[a]++] = b; });
    std::vector<std::array<Index, 2>> open;
    std::size_t begin = 0;
    for (Index a = 0; a < vertices; ++a) {  // each place is where the next vertex begins now
        poll();
        const std::size_t end = place[a];
        std::sort(larger.begin() + static_cast<std::ptrdiff_t>(begin),
                  larger.begin() + static_cast<std::ptrdiff_t>(end));
        for (std::size_t i = begin; i < end;) {
            std::size_t next = i + 1;
            while (next < end && larger[next] == larger[i]) ++next;
            if (next == i + 1) open.push_back({a, larger[i]});
            i = next;
        }
        begin = end;
    }
    return open;
}

/// Calls visit(OpenEdge) for each open edge there would be at the vertex that u and v become. O(valence
/// squared)
template <class Visit>
void for_each_open_edge_after(const Complex& complex, const PairTable& pairs, Index u, Index v,
                              Visit&& visit) {
    using namespace open_edges;
    pairs.for_each_pair(u, [&](Neighbour n) {
        const std::uint32_t with_u = pairs.face_count(n.pair);
        if (n.vertex == v || with_u == 0) return;
        const std::uint32_t with_v = faces_of_edge(complex, pairs, v, n.vertex);
        const std::uint32_t gone = with_v > 0 ? 2 * complex.faces_with(u, v, n.vertex) : 0;
        if (with_u + with_v - gone == 1) visit(OpenEdge{n.vertex, with_u, with_v});
    });
    pairs.for_each_pair(v, [&](Neighbour n) {
        if (n.vertex == u || pairs.face_count(n.pair) != 1) return;
        if (faces_of_edge(complex, pairs, u, n.vertex) == 0) visit(OpenEdge{n.vertex, 0, 1});
    });
}

}  // namespace engine
FAQEM_NAMESPACE_END
