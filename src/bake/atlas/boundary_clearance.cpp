#include "bake/atlas/boundary_clearance.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "bake/atlas/box_grid.hpp"
#include "faqem/engine/mesh/vector.hpp"

namespace faqem::detail {
namespace {

using engine::Vector3;

constexpr double reach = 1.5;  // texels

// An edge of the outline, on the page and on the surface.
struct Side {
    ChartPoint a, b;  // texels
    Vector3 at_a, at_b;
    double density;  // texels per length

    ChartPoint place(double at) const { return a + at * (b - a); }
    Vector3 point(double at) const { return at_a + at * (at_b - at_a); }
    // Of the closest point to p, 0 at a and 1 at b.
    double closest(const ChartPoint& p) const {
        const double length = std::norm(b - a);
        return length > 0 ? std::clamp((std::conj(b - a) * (p - a)).real() / length, 0.0, 1.0) : 0;
    }
};

std::vector<Side> outline(std::span<const ChartFace> all, const Chart& chart, engine::Poll poll) {
    std::vector<Side> sides;
    for (std::size_t i = 0; i < chart.faces.size(); ++i) {
        poll();
        const ChartFace& face = all[chart.faces[i]];
        for (std::size_t c = 0; c < 3; ++c) {
            const Index other = face.across[c].triangle;
            if (other != no_index && std::binary_search(chart.faces.begin(), chart.faces.end(), other))
                continue;
            const std::size_t from = (c + 1) % 3, to = (c + 2) % 3;
            sides.push_back({chart.places[i][from], chart.places[i][to], engine::to_eigen(face.corners[from]),
                             engine::to_eigen(face.corners[to]), face.density});
        }
    }
    return sides;
}

// Whether places on one side are about as far from another one as it looks: the ends, and the place from where
// on they are out of reach.
bool is_clear(const Side& s, const Side& t) {
    const auto distance = [&](double at) {
        const ChartPoint p = s.place(at);
        return std::abs(t.place(t.closest(p)) - p);
    };
    const auto is_clear_at = [&](double at, double flat) {
        const double length = (t.point(t.closest(s.place(at))) - s.point(at)).norm();
        return length * std::min(s.density, t.density) <= 1.5 * flat + 0.5;
    };
    const double a = distance(0), b = distance(1);
    if (a < reach && !is_clear_at(0, a)) return false;
    if (b < reach && !is_clear_at(1, b)) return false;
    if ((a < reach) == (b < reach)) return true;
    const double last = (reach - a) / (b - a);
    return is_clear_at(last, distance(last));
}

}  // namespace

bool outline_is_clear(std::span<const ChartFace> all, const Chart& chart, std::uint64_t& work,
                      engine::Poll poll) {
    const std::vector<Side> sides = outline(all, chart, poll);
    std::vector<Box> boxes;
    boxes.reserve(sides.size());
    for (const Side& s : sides) {
        poll();
        const auto [x0, x1] = std::minmax({s.a.real(), s.b.real()});
        const auto [y0, y1] = std::minmax({s.a.imag(), s.b.imag()});
        boxes.push_back({x0 - reach / 2, y0 - reach / 2, x1 + reach / 2, y1 + reach / 2});
    }
    const std::optional<BoxGrid> grid = BoxGrid::over(boxes, work);
    if (!grid) return false;
    return grid->all_pairs(boxes, work, poll, [&](Index a, Index b) {
        return is_clear(sides[a], sides[b]) && is_clear(sides[b], sides[a]);
    });
}

}  // namespace faqem::detail
