// Boundary clearance of charts.

#include "bake/atlas/triangle_overlap.hpp"

#include <cmath>
#include <numbers>

#include "support/catch.hpp"

using namespace faqem;
using detail::Chart;
using detail::PageTriangle;
using detail::Point2;

namespace {

struct Fan {
    std::vector<PageTriangle> faces;
    Chart chart;
};

// A flat fan of triangles around a point, with the given angles on the surface and in the chart, and legs of
// the given length in texels.
Fan fan(std::size_t count, double angle, double flat_angle, double legs) {
    Fan result;
    for (std::size_t i = 0; i < count; ++i) {
        const auto at = [&](std::size_t k, double a) {
            return Point2{legs * std::cos(a * double(k)), legs * std::sin(a * double(k))};
        };
        PageTriangle face;
        const Point2 p = at(i, angle), q = at(i + 1, angle);
        face.corners = {Vec3{0, 0, 0}, Vec3{p.x, p.y, 0}, Vec3{q.x, q.y, 0}};
        if (i + 1 < count) face.adjacent[1] = {static_cast<Index>(i + 1), 2};
        if (i > 0) face.adjacent[2] = {static_cast<Index>(i - 1), 1};
        result.faces.push_back(face);
        result.chart.faces.push_back(static_cast<Index>(i));
        result.chart.points.push_back({Point2{0, 0}, at(i, flat_angle), at(i + 1, flat_angle)});
    }
    return result;
}

bool clear(const Fan& f) {
    std::uint64_t work = 1000;
    return detail::has_boundary_clearance(f.faces, f.chart, work);
}

constexpr double degree = std::numbers::pi / 180;

}  // namespace

TEST_CASE("a slit that is as wide in the chart as on the surface has clearance") {
    CHECK(clear(fan(5, 60 * degree, 60 * degree, 10)));
    CHECK(clear(fan(5, 71 * degree, 71 * degree, 10)));
    CHECK(clear(fan(5, 71.9 * degree, 71.9 * degree, 10)));
}

TEST_CASE("a slit narrower in the chart than on the surface has no clearance unless the chart is tiny") {
    CHECK_FALSE(clear(fan(5, 60 * degree, 71 * degree, 10)));
    CHECK_FALSE(clear(fan(5, 60 * degree, 70 * degree, 3)));
    CHECK(clear(fan(5, 60 * degree, 71 * degree, 0.4)));
}

TEST_CASE("the clearance of a long slit is tested where it is narrow") {
    // The opening is 10 degrees instead of 60, and 17 texels wide at its ends.
    CHECK_FALSE(clear(fan(5, 60 * degree, 70 * degree, 100)));
    CHECK(clear(fan(5, 60 * degree, 64 * degree, 100)));  // an opening of 40 degrees
}

TEST_CASE("a clearance test beyond the work limit fails") {
    const Fan f = fan(5, 60 * degree, 60 * degree, 10);
    std::uint64_t work = 3;
    CHECK_FALSE(detail::has_boundary_clearance(f.faces, f.chart, work));
}
