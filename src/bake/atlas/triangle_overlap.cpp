#include "bake/atlas/triangle_overlap.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "faqem/detail/base/buckets.hpp"
#include "faqem/detail/base/vector.hpp"

namespace faqem::detail {
namespace {

// Broad phase: a uniform grid with about as many cells as boxes, and the boxes that overlap each cell.
class BoxGrid {
public:
    // Chooses the extent and the cell size; the cells are still empty.
    // \param boxes  at least one, all finite
    explicit BoxGrid(std::span<const Box2> boxes) : boxes_(boxes) {
        Box2 all;
        for (const Box2& b : boxes) {
            all.add(b.low);
            all.add(b.high);
        }
        low_ = all.low;
        const double cell =
            std::max({std::sqrt(all.width() * all.height() / static_cast<double>(boxes.size())),
                      all.size() / 4096, std::numeric_limits<double>::min()});
        scale_ = 1 / cell;
        columns_ = static_cast<std::size_t>(all.width() * scale_) + 1;
        rows_ = static_cast<std::size_t>(all.height() * scale_) + 1;
    }

    // Adds the boxes to the cells. Returns false if `work`, which is decreased by the number of entries, does not suffice.
    bool fill(std::uint64_t& work) {
        std::uint64_t entries = 0;
        for (const Box2& b : boxes_) {
            entries += (column(b.high.x) - column(b.low.x) + 1) * (row(b.high.y) - row(b.low.y) + 1);
            if (entries > work) {
                work = 0;
                return false;
            }
        }
        work -= entries;
        members_ = Buckets<Index>(columns_ * rows_, [&](auto&& put) {
            for (Index i = 0; i < boxes_.size(); ++i) {
                const Box2& b = boxes_[i];
                for (std::size_t y = row(b.low.y); y <= row(b.high.y); ++y)
                    for (std::size_t x = column(b.low.x); x <= column(b.high.x); ++x)
                        put(y * columns_ + x, i);
            }
        });
        return true;
    }

    // Calls test(a, b) once for every pair of boxes that share a cell, until it returns false or `work`, which is decreased
    // by the number of visited pairs, is used up. Returns whether neither has happened.
    template <class Test>
    bool all_pairs(std::uint64_t& work, const Test& test) const {
        for (std::size_t cell = 0; cell < columns_ * rows_; ++cell) {
            const std::span<const Index> members = members_[cell];
            for (std::size_t i = 0; i < members.size(); ++i) {
                const Box2& a = boxes_[members[i]];
                for (std::size_t j = i + 1; j < members.size(); ++j) {
                    if (work == 0) return false;
                    --work;
                    const Box2& b = boxes_[members[j]];
                    // A pair is tested once, in the first cell that both boxes overlap.
                    const std::size_t x = column(std::max(a.low.x, b.low.x)),
                                      y = row(std::max(a.low.y, b.low.y));
                    if (y * columns_ + x != cell) continue;
                    if (!test(members[i], members[j])) return false;
                }
            }
        }
        return true;
    }

private:
    std::size_t column(double x) const {
        return std::min(columns_ - 1, static_cast<std::size_t>((x - low_.x) * scale_));
    }
    std::size_t row(double y) const {
        return std::min(rows_ - 1, static_cast<std::size_t>((y - low_.y) * scale_));
    }

    std::span<const Box2> boxes_;
    Point2 low_;    // lower left corner of the grid
    double scale_;  // cells per unit of length
    std::size_t columns_, rows_;
    Buckets<Index> members_;  // indices of boxes by cell
};

// Whether test(a, b) returns true for every pair of boxes that share a cell of a grid. Returns false also if `work` is used
// up before, or if a box is not finite.
template <class Test>
bool all_pairs(std::span<const Box2> boxes, std::uint64_t& work, const Test& test) {
    for (const Box2& b : boxes)
        if (!std::isfinite(b.low.x + b.low.y + b.high.x + b.high.y)) return false;
    BoxGrid grid(boxes);
    return grid.fill(work) && grid.all_pairs(work, test);
}

// Whether b is on the outer side of an edge of a, with a tolerance of `slack`.
bool has_separating_edge(const Triangle2& a, const Triangle2& b, double slack) {
    for (std::size_t i = 0; i < 3; ++i) {
        const Point2 &from = a[i], &to = a[(i + 1) % 3];
        const double limit = slack * length(to - from);
        if (twice_signed_area(from, to, b[0]) <= limit && twice_signed_area(from, to, b[1]) <= limit &&
            twice_signed_area(from, to, b[2]) <= limit)
            return true;
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

constexpr double max_overlap_distance = 1.5;  // texels

// A boundary edge of the chart, on the page and on the surface.
struct ChartBoundaryEdge {
    Point2 a, b;  // texels
    Vector3 surface_a, surface_b;
    double density;  // texels per unit of length

    // Point of the edge on the page: a for 0, b for 1.
    Point2 page_point(double at) const { return point_on_line(a, b, at); }
    // Point of the edge on the surface: surface_a for 0, surface_b for 1.
    Vector3 surface_point(double at) const { return surface_a + at * (surface_b - surface_a); }
    // Parameter of the point closest to p: 0 at a, 1 at b.
    double closest(const Point2& p) const { return closest_on_segment(a, b, p); }
};

// The boundary edges of a chart, face by face.
std::vector<ChartBoundaryEdge> boundary_edges(std::span<const PageTriangle> all, const Chart& chart) {
    std::vector<ChartBoundaryEdge> edges;
    for (std::size_t i = 0; i < chart.faces.size(); ++i) {
        const PageTriangle& face = all[chart.faces[i]];
        for (std::size_t c = 0; c < 3; ++c) {
            const Index other = face.adjacent[c].triangle;
            if (other != no_index && std::ranges::binary_search(chart.faces, other)) continue;
            const std::size_t from = (c + 1) % 3, to = (c + 2) % 3;
            edges.push_back({chart.points[i][from], chart.points[i][to], to_eigen(face.corners[from]),
                             to_eigen(face.corners[to]), face.density});
        }
    }
    return edges;
}

// Whether points of s are about as far from t on the surface as on the page. Tests the ends of s and, if only
// one of them is closer to t than max_overlap_distance, the point in between where the distance reaches max_overlap_distance.
bool has_clearance(const ChartBoundaryEdge& s, const ChartBoundaryEdge& t) {
    const auto distance = [&](double at) {
        const Point2 p = s.page_point(at);
        return length(t.page_point(t.closest(p)) - p);
    };
    const auto has_clearance_at = [&](double at, double flat) {
        const double on_surface = (t.surface_point(t.closest(s.page_point(at))) - s.surface_point(at)).norm();
        return on_surface * std::min(s.density, t.density) <= 1.5 * flat + 0.5;
    };
    const double a = distance(0), b = distance(1);
    if (a < max_overlap_distance && !has_clearance_at(0, a)) return false;
    if (b < max_overlap_distance && !has_clearance_at(1, b)) return false;
    if ((a < max_overlap_distance) == (b < max_overlap_distance)) return true;
    const double last = (max_overlap_distance - a) / (b - a);
    return has_clearance_at(last, distance(last));
}

}  // namespace

bool have_disjoint_interiors(std::span<const Triangle2> triangles, std::uint64_t& work) {
    if (triangles.size() < 2) return true;
    std::vector<Box2> boxes;
    boxes.reserve(triangles.size());
    for (const Triangle2& t : triangles) boxes.push_back(bounding_box(t));
    return all_pairs(boxes, work, [&](Index a, Index b) {
        return is_separated(triangles[a], boxes[a], triangles[b], boxes[b]);
    });
}

bool has_boundary_clearance(std::span<const PageTriangle> all, const Chart& chart, std::uint64_t& work) {
    const std::vector<ChartBoundaryEdge> edges = boundary_edges(all, chart);
    std::vector<Box2> boxes;
    boxes.reserve(edges.size());
    for (const ChartBoundaryEdge& s : edges)
        boxes.push_back(bounding_box(std::array{s.a, s.b}).expanded(max_overlap_distance / 2));
    return all_pairs(boxes, work, [&](Index a, Index b) {
        return has_clearance(edges[a], edges[b]) && has_clearance(edges[b], edges[a]);
    });
}

}  // namespace faqem::detail
