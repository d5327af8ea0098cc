#include "bake/atlas/boundary_clearance.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <vector>

#include "bake/atlas/box_grid.hpp"
#include "faqem/engine/mesh/vector.hpp"

namespace faqem::detail {
namespace {

using engine::Vector3;

constexpr double max_distance = 1.5;  // texels

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
            edges.push_back({chart.points[i][from], chart.points[i][to], engine::to_eigen(face.corners[from]),
                             engine::to_eigen(face.corners[to]), face.density});
        }
    }
    return edges;
}

// Whether points of s are about as far from t on the surface as on the page. Tests the ends of s and, if only
// one of them is closer to t than max_distance, the point in between where the distance reaches max_distance.
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
    if (a < max_distance && !has_clearance_at(0, a)) return false;
    if (b < max_distance && !has_clearance_at(1, b)) return false;
    if ((a < max_distance) == (b < max_distance)) return true;
    const double last = (max_distance - a) / (b - a);
    return has_clearance_at(last, distance(last));
}

}  // namespace

bool has_boundary_clearance(std::span<const PageTriangle> all, const Chart& chart, std::uint64_t& work) {
    const std::vector<ChartBoundaryEdge> edges = boundary_edges(all, chart);
    std::vector<Box2> boxes;
    boxes.reserve(edges.size());
    for (const ChartBoundaryEdge& s : edges) {
        boxes.push_back(bounding_box(std::array{s.a, s.b}).expanded(max_distance / 2));
    }
    const std::optional<BoxGrid> grid = BoxGrid::build(boxes, work);
    if (!grid) return false;
    return grid->all_pairs(boxes, work, [&](Index a, Index b) {
        return has_clearance(edges[a], edges[b]) && has_clearance(edges[b], edges[a]);
    });
}

}  // namespace faqem::detail
