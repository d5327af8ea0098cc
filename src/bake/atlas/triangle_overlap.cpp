#include "bake/atlas/triangle_overlap.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "bake/atlas/box_grid.hpp"

namespace faqem::detail {
namespace {

using FlatTriangle = std::array<ChartPoint, 3>;

Box2 box_of(const FlatTriangle& t) {
    const auto [x0, x1] = std::minmax({t[0].real(), t[1].real(), t[2].real()});
    const auto [y0, y1] = std::minmax({t[0].imag(), t[1].imag(), t[2].imag()});
    return {x0, y0, x1, y1};
}

// Whether b is on the outer side of an edge of a, with a tolerance of `slack`.
bool has_separating_edge(const FlatTriangle& a, const FlatTriangle& b, double slack) {
    for (std::size_t i = 0; i < 3; ++i) {
        const ChartPoint &from = a[i], &to = a[(i + 1) % 3];
        const double limit = slack * std::abs(to - from);
        if (twice_signed_area(from, to, b[0]) <= limit && twice_signed_area(from, to, b[1]) <= limit &&
            twice_signed_area(from, to, b[2]) <= limit) {
            return true;
        }
    }
    return false;
}

// Two convex polygons are disjoint if and only if an edge of one of them separates them.
bool is_separated(const FlatTriangle& a, const Box2& box_a, const FlatTriangle& b, const Box2& box_b) {
    const double slack = 1e-9 * std::max(box_a.size(), box_b.size());
    if (box_a.high_x <= box_b.low_x + slack || box_b.high_x <= box_a.low_x + slack) return true;
    if (box_a.high_y <= box_b.low_y + slack || box_b.high_y <= box_a.low_y + slack) return true;
    return has_separating_edge(a, b, slack) || has_separating_edge(b, a, slack);
}

}  // namespace

bool have_disjoint_interiors(std::span<const FlatTriangle> triangles, std::uint64_t& work,
                             engine::CancellationCheck check_cancelled) {
    if (triangles.size() < 2) return true;
    std::vector<Box2> boxes;
    boxes.reserve(triangles.size());
    for (const FlatTriangle& t : triangles) boxes.push_back(box_of(t));
    const std::optional<BoxGrid> grid = BoxGrid::build(boxes, work);
    if (!grid) return false;
    return grid->all_pairs(boxes, work, check_cancelled, [&](Index a, Index b) {
        return is_separated(triangles[a], boxes[a], triangles[b], boxes[b]);
    });
}

}  // namespace faqem::detail
