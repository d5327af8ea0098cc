#pragma once
/// \file
/// Matching of triangles across mesh edges: partners share a cell of the per-triangle atlas.

#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "faqem/mesh.hpp"

namespace faqem::detail {

/// The triangle across an edge, and its corner opposite this edge.
struct AdjacentTriangle {
    Index triangle = no_index;
    std::uint8_t corner = 0;
};

/// Input triangle of the matching. Entry i of both arrays is for the edge opposite corner i.
struct PairTriangle {
    std::array<double, 3> edges = {0, 0, 0};        ///< wanted lengths in texels
    std::array<AdjacentTriangle, 3> adjacent = {};  ///< symmetric; `no_index` at the boundary
};

/// Largest ratio of a pair's rectangle to the texels of the two triangles in cells of their own. For example,
/// two slivers that share a short edge need fewer texels in cells of their own.
inline constexpr double max_waste = 1.3;

/// Side of a pair's rectangle for two triangles with legs a and b along it: their root mean square.
inline double shared_side(double a, double b) { return std::sqrt((a * a + b * b) / 2); }

/// Matches adjacent triangles in pairs. A pair fills a rectangle whose diagonal is the shared edge.
/// Pairs are matched greedily in ascending order of waste (texels of the rectangle divided by those of the
/// two triangles in cells of their own; ties by index). No pair has a waste above `max_waste`.
/// \return by triangle: the corner opposite the edge to its partner, or 3 if it has no partner
/// Complexity: O(n log n).
std::vector<std::uint8_t> pair_triangles(std::span<const PairTriangle> triangles);

}  // namespace faqem::detail
