// Slits in charts, and the grid that finds them.

#include "bake/atlas/boundary_clearance.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <random>
#include <set>

#include "bake/atlas/box_grid.hpp"

using namespace faqem;
using detail::Box2;
using detail::BoxGrid;
using detail::Chart;
using detail::ChartFace;
using detail::ChartPoint;

namespace {

struct Fan {
    std::vector<ChartFace> faces;
    Chart chart;
};

// Triangles around a point, each of the given angle on the surface (where they make a flat fan) and in the
// chart, with legs of so many texels.
Fan fan(std::size_t count, double angle, double flat_angle, double legs) {
    Fan result;
    for (std::size_t i = 0; i < count; ++i) {
        const auto at = [&](std::size_t k, double a) { return std::polar(legs, a * double(k)); };
        ChartFace face;
        const ChartPoint p = at(i, angle), q = at(i + 1, angle);
        face.corners = {Vec3{0, 0, 0}, Vec3{p.real(), p.imag(), 0}, Vec3{q.real(), q.imag(), 0}};
        if (i + 1 < count) face.adjacent[1] = {static_cast<Index>(i + 1), 2};
        if (i > 0) face.adjacent[2] = {static_cast<Index>(i - 1), 1};
        result.faces.push_back(face);
        result.chart.faces.push_back(static_cast<Index>(i));
        result.chart.points.push_back({ChartPoint{0, 0}, at(i, flat_angle), at(i + 1, flat_angle)});
    }
    return result;
}

bool clear(const Fan& f) {
    std::uint64_t work = 1000;
    return detail::has_boundary_clearance(f.faces, f.chart, work);
}

constexpr double degree = std::numbers::pi / 180;

}  // namespace

TEST_CASE("a fan with a wedge as open as on the surface is clear, however narrow it is") {
    CHECK(clear(fan(5, 60 * degree, 60 * degree, 10)));
    CHECK(clear(fan(5, 71 * degree, 71 * degree, 10)));
    CHECK(clear(fan(5, 71.9 * degree, 71.9 * degree, 10)));
}

TEST_CASE("a wedge that is squeezed to a slit is not clear, unless a texel is larger than it") {
    CHECK_FALSE(clear(fan(5, 60 * degree, 71 * degree, 10)));
    CHECK_FALSE(clear(fan(5, 60 * degree, 70 * degree, 3)));
    CHECK(clear(fan(5, 60 * degree, 71 * degree, 0.4)));
}

TEST_CASE("a long slit is looked at where it is narrow, not at its ends only") {
    // 10 degrees are open instead of 60: 17 texels at the ends.
    CHECK_FALSE(clear(fan(5, 60 * degree, 70 * degree, 100)));
    CHECK(clear(fan(5, 60 * degree, 64 * degree, 100)));  // 40
}

TEST_CASE("an outline that takes more work than is allowed is not known to be clear") {
    const Fan f = fan(5, 60 * degree, 60 * degree, 10);
    std::uint64_t work = 3;
    CHECK_FALSE(detail::has_boundary_clearance(f.faces, f.chart, work));
}

TEST_CASE("a grid finds all pairs of boxes that meet, each once") {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> place(-50, 50), size(0, 9);
    std::vector<Box2> boxes;
    for (int i = 0; i < 200; ++i) {
        const double x = place(random), y = place(random);
        boxes.push_back({x, y, x + size(random), y + size(random)});
    }
    std::uint64_t work = 1000000;
    const auto grid = BoxGrid::build(boxes, work);
    REQUIRE(grid);
    std::set<std::pair<Index, Index>> seen;
    CHECK(grid->all_pairs(boxes, work, {}, [&](Index a, Index b) {
        CHECK(seen.insert(std::minmax(a, b)).second);
        return true;
    }));
    for (Index a = 0; a < 200; ++a) {
        for (Index b = a + 1; b < 200; ++b) {
            const bool meet = boxes[a].low_x <= boxes[b].high_x && boxes[b].low_x <= boxes[a].high_x &&
                              boxes[a].low_y <= boxes[b].high_y && boxes[b].low_y <= boxes[a].high_y;
            if (meet) CHECK(seen.count({a, b}) == 1);
        }
    }
}
