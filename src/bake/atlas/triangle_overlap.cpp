#include "bake/atlas/triangle_overlap.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "bake/atlas/box_grid.hpp"

namespace faqem::detail {
namespace {

using Flat = std::array<ChartPoint, 3>;

Box box_of(const Flat& t) {
    const auto [x0, x1] = std::minmax({t[0].real(), t[1].real(), t[2].real()});
    const auto [y0, y1] = std::minmax({t[0].imag(), t[1].imag(), t[2].imag()});
    return {x0, y0, x1, y1};
}

// Whether an edge of a has all of b outside of it, or within `slack` of that.
bool parted_by_edge(const Flat& a, const Flat& b, double slack) {
    for (std::size_t i = 0; i < 3; ++i) {
        const ChartPoint &from = a[i], &to = a[(i + 1) % 3];
        const double limit = slack * std::abs(to - from);
        if (turn(from, to, b[0]) <= limit && turn(from, to, b[1]) <= limit && turn(from, to, b[2]) <= limit) {
            return true;
        }
    }
    return false;
}

// Two convex shapes are apart if and only if an edge of one of them parts them.
bool parted(const Flat& a, const Box& box_a, const Flat& b, const Box& box_b) {
    const double slack = 1e-9 * std::max(box_a.size(), box_b.size());
    if (box_a.high_x <= box_b.low_x + slack || box_b.high_x <= box_a.low_x + slack) return true;
    if (box_a.high_y <= box_b.low_y + slack || box_b.high_y <= box_a.low_y + slack) return true;
    return parted_by_edge(a, b, slack) || parted_by_edge(b, a, slack);
}

}  // namespace

bool apart(std::span<const Flat> triangles, std::uint64_t& work, engine::Poll poll) {
    if (triangles.size() < 2) return true;
    std::vector<Box> boxes;
    boxes.reserve(triangles.size());
    for (const Flat& t : triangles) boxes.push_back(box_of(t));
    const std::optional<BoxGrid> grid = BoxGrid::over(boxes, work);
    if (!grid) return false;
    return grid->all_pairs(boxes, work, poll, [&](Index a, Index b) {
        return parted(triangles[a], boxes[a], triangles[b], boxes[b]);
    });
}

}  // namespace faqem::detail
