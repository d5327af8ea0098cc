#pragma once
/// \file
/// Which triangles share a cell of the per-triangle atlas: matching across mesh edges.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "faqem/engine/util/cancellation.hpp"
#include "faqem/mesh.hpp"

namespace faqem::detail {

/// A triangle across an edge, and its corner opposite that edge.
struct AdjacentTriangle {
    Index triangle = no_index;
    std::uint8_t corner = 0;
};

/// What the matching must know of a triangle. Entry i of both is for the edge opposite corner i.
struct PairTriangle {
    std::array<double, 3> edges = {0, 0, 0};        ///< wanted lengths in texels
    std::array<AdjacentTriangle, 3> adjacent = {};  ///< mutual; no_index at borders
};

/// Two slivers that share a short edge are better off in cells of their own.
inline constexpr double max_waste = 1.3;

/// By triangle: the corner opposite the edge to its partner, 3 where it stays alone.
/// A pair fills a rectangle with the shared edge as diagonal. Pairs that waste least come first (rectangle
/// against triangles, ties by index); then paths of up to seven edges are turned over where that leaves fewer
/// alone. A pair whose rectangle has more than `max_waste` times the texels of the two by themselves is
/// never made. O(n log n)
/// \throws what the poll throws
std::vector<std::uint8_t> pair_triangles(std::span<const PairTriangle> triangles,
                                         engine::CancellationCheck check_cancelled = {});

}  // namespace faqem::detail
