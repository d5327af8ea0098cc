#include "bake/atlas/triangle_overlap.hpp"

#include <algorithm>
#include <vector>

#include "bake/atlas/box_grid.hpp"

namespace faqem::detail {
namespace {

// Whether b is on the outer side of an edge of a, with a tolerance of `slack`.
bool has_separating_edge(const Triangle2& a, const Triangle2& b, double slack) {
    for (std::size_t i = 0; i < 3; ++i) {
        const Point2 &from = a[i], &to = a[(i + 1) % 3];
        const double limit = slack * length(to - from);
        if (twice_signed_area(from, to, b[0]) <= limit && twice_signed_area(from, to, b[1]) <= limit &&
            twice_signed_area(from, to, b[2]) <= limit) {
            return true;
        }
    }
    return false;
}

// Two convex polygons are disjoint if and only if an edge of one of them separates them.
bool is_separated(const Triangle2& a, const Box2& box_a, const Triangle2& b, const Box2& box_b) {
    const double slack = 1e-9 * std::max(box_a.size(), box_b.size());
    if (box_a.high.x <= box_b.low.x + slack || box_b.high.x <= box_a.low.x + slack) return true;
    if (box_a.high.y <= box_b.low.y + slack || box_b.high.y <= box_a.low.y + slack) return true;
    return has_separating_edge(a, b, slack) || has_separating_edge(b, a, slack);
}

}  // namespace

bool have_disjoint_interiors(std::span<const Triangle2> triangles, std::uint64_t& work) {
    if (triangles.size() < 2) return true;
    std::vector<Box2> boxes;
    boxes.reserve(triangles.size());
    for (const Triangle2& t : triangles) boxes.push_back(bounding_box(t));
    const std::optional<BoxGrid> grid = BoxGrid::build(boxes, work);
    if (!grid) return false;
    return grid->all_pairs(boxes, work, [&](Index a, Index b) {
        return is_separated(triangles[a], boxes[a], triangles[b], boxes[b]);
    });
}

}  // namespace faqem::detail
