#pragma once
/// \file
/// The open edges that a collapse would leave.

#include <cstdint>

#include "faqem/engine/complex.hpp"
#include "faqem/engine/pairs.hpp"

namespace faqem::engine {

/// An edge with one face, from the vertex that a pair (u, v) would become.
struct OpenEdge {
    Index vertex;                  ///< its other end
    std::uint32_t with_u, with_v;  ///< faces that the other end has with u and with v until then
};

namespace open_edges {

inline std::uint32_t faces_of_edge(const PairTable& pairs, Index v, Index other) {
    std::uint32_t count = 0;
    pairs.for_each_pair(v, [&](Neighbour n) {
        if (n.vertex == other) count = pairs.face_count(n.pair);
    });
    return count;
}

}  // namespace open_edges

/// Calls visit(OpenEdge) for each open edge there would be at the vertex that u and v become. O(valence
/// squared)
template <class Visit>
void for_each_open_edge_after(const Complex& complex, const PairTable& pairs, Index u, Index v,
                              Visit&& visit) {
    using namespace open_edges;
    pairs.for_each_pair(u, [&](Neighbour n) {
        const std::uint32_t with_u = pairs.face_count(n.pair);
        if (n.vertex == v || with_u == 0) return;
        const std::uint32_t with_v = faces_of_edge(pairs, v, n.vertex);
        const std::uint32_t gone = with_v > 0 ? 2 * complex.faces_with(u, v, n.vertex) : 0;
        if (with_u + with_v - gone == 1) visit(OpenEdge{n.vertex, with_u, with_v});
    });
    pairs.for_each_pair(v, [&](Neighbour n) {
        if (n.vertex == u || pairs.face_count(n.pair) != 1) return;
        if (faces_of_edge(pairs, u, n.vertex) == 0) visit(OpenEdge{n.vertex, 0, 1});
    });
}

}  // namespace faqem::engine
