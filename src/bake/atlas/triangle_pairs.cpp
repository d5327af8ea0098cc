#include "bake/atlas/triangle_pairs.hpp"

#include <algorithm>
#include <tuple>

namespace faqem::detail {
namespace {

constexpr std::uint8_t no_partner = 3;

// Lengths of the edges from a corner to the next one and to the one after it.
std::array<double, 2> legs_at(const PairTriangle& triangle, std::size_t corner) {
    return {triangle.edges[(corner + 2) % 3], triangle.edges[(corner + 1) % 3]};
}

// Texels of a triangle without a partner: its largest angle becomes a right angle, and it covers half of the
// rectangle over its two shorter edges.
double unpaired_texels(const PairTriangle& triangle) {
    const auto& e = triangle.edges;
    const double longest = std::max({e[0], e[1], e[2]});
    return longest > 0 ? e[0] * e[1] * e[2] / longest / 2 : 0;
}

// Texels of the rectangle divided by those of the separate triangles.
double waste(std::span<const PairTriangle> triangles, Index t, std::uint8_t corner) {
    const AdjacentTriangle& other = triangles[t].adjacent[corner];
    const auto a = legs_at(triangles[t], corner), b = legs_at(triangles[other.triangle], other.corner);
    return shared_side(a[0], b[0]) * shared_side(a[1], b[1]) /
           (unpaired_texels(triangles[t]) + unpaired_texels(triangles[other.triangle]));
}

}  // namespace

std::vector<std::uint8_t> pair_triangles(std::span<const PairTriangle> triangles) {
    std::vector<std::tuple<double, Index, std::uint8_t>> candidates;  // waste, triangle and its corner
    for (Index t = 0; t < triangles.size(); ++t) {
        for (std::uint8_t c = 0; c < 3; ++c) {
            const Index other = triangles[t].adjacent[c].triangle;
            if (other == no_index || other < t) continue;
            const double wasted = waste(triangles, t, c);
            if (wasted <= max_waste) candidates.emplace_back(wasted, t, c);
        }
    }
    std::sort(candidates.begin(), candidates.end());
    std::vector<std::uint8_t> corner(triangles.size(), no_partner);
    for (const auto& [wasted, t, c] : candidates) {
        const AdjacentTriangle& other = triangles[t].adjacent[c];
        if (corner[t] != no_partner || corner[other.triangle] != no_partner) continue;
        corner[t] = c;
        corner[other.triangle] = other.corner;
    }
    return corner;
}

}  // namespace faqem::detail
