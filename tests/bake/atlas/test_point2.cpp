// Points, triangles and bounding boxes in the plane, compared with closed forms.

#include "bake/atlas/point2.hpp"
#include "support/catch.hpp"

#include <cmath>
#include <limits>
#include <numbers>

using namespace faqem::detail;

namespace {

/// The unit vector at an angle to the x axis.
Point2 direction(double angle) { return {std::cos(angle), std::sin(angle)}; }

}  // namespace

TEST_CASE("points are added, subtracted, scaled and compared by coordinate") {
    CHECK(Point2{} == Point2{0, 0});
    CHECK(Point2{1, 2} + Point2{3, -5} == Point2{4, -3});
    CHECK(Point2{1, 2} - Point2{3, -5} == Point2{-2, 7});
    CHECK(Point2{1, -2} * 3 == Point2{3, -6});
    CHECK(Point2{1, 2} != Point2{2, 1});
    CHECK(Point2{1, 2} != Point2{1, 3});
}

TEST_CASE("products of vectors are those of their lengths with the cosine and the sine of the angle") {
    for (const double a : {0.0, 0.3, 1.0, 2.5, 4.0}) {
        for (const double b : {0.0, 0.7, 1.9, 3.3, 6.0}) {
            const Point2 p = direction(a) * 2, q = direction(b) * 3;
            CHECK(dot(p, q) == Approx(6 * std::cos(b - a)).margin(1e-14));
            CHECK(cross(p, q) == Approx(6 * std::sin(b - a)).margin(1e-14));
            CHECK(cross(p, q) == -cross(q, p));
        }
    }
    CHECK(dot(Point2{3, 4}, Point2{-4, 3}) == 0);
    CHECK(cross(Point2{3, 4}, Point2{6, 8}) == 0);
}

TEST_CASE("lengths do not overflow or underflow") {
    CHECK(length(Point2{3, -4}) == 5);
    CHECK(squared_length(Point2{3, -4}) == 25);
    CHECK(length(Point2{3e200, 4e200}) == Approx(5e200));
    CHECK(length(Point2{3e-200, 4e-200}) == Approx(5e-200));
}

TEST_CASE("rotated adds the angle of the direction") {
    CHECK(rotated({3, 4}, {1, 0}) == Point2{3, 4});
    CHECK(rotated({3, 4}, {0, 1}) == Point2{-4, 3});
    CHECK(rotated({3, 4}, {-1, 0}) == Point2{-3, -4});
    for (const double angle : {0.4, 1.7, 3.9}) {
        const Point2 p = rotated(direction(0.5) * 7, direction(angle));
        CHECK(length(p - direction(0.5 + angle) * 7) < 1e-14);
    }
}

TEST_CASE("the signed area is positive for counter-clockwise triangles") {
    CHECK(twice_signed_area({1, 1}, {5, 1}, {1, 4}) == 12);
    CHECK(twice_signed_area({1, 1}, {1, 4}, {5, 1}) == -12);
    CHECK(twice_signed_area({5, 1}, {1, 4}, {1, 1}) == 12);
    CHECK(twice_signed_area({0, 0}, {1, 2}, {3, 6}) == 0);
    // A corner of a regular hexagon, its successor and the centre form an equilateral triangle.
    const double third = std::numbers::pi / 3;
    CHECK(twice_signed_area({0, 0}, direction(1), direction(1 + third)) == Approx(std::sin(third)));
}

TEST_CASE("the closest point of a segment is the foot of the perpendicular or an end") {
    const Point2 a = {1, 2}, b = {9, 8};  // length 10
    CHECK(closest_on_segment(a, b, {5, 5}) == 0.5);
    CHECK(closest_on_segment(a, b, a) == 0);
    CHECK(closest_on_segment(a, b, b) == 1);
    CHECK(closest_on_segment(a, b, {-7, -4}) == 0);
    CHECK(closest_on_segment(a, b, {100, 100}) == 1);
    CHECK(closest_on_segment(a, a, b) == 0);
    CHECK(point_on_line(a, b, 0) == a);
    CHECK(point_on_line(a, b, 1) == b);
    CHECK(point_on_line(a, b, 0.25) == Point2{3, 3.5});
    CHECK(point_on_line(a, b, -1) == Point2{-7, -4});
    // 5 to the left of the point with parameter 0.25.
    const Point2 left = Point2{3, 3.5} + Point2{-3, 4};
    CHECK(closest_on_segment(a, b, left) == Approx(0.25));
    CHECK(squared_distance_to_segment(a, b, left) == Approx(25));
    CHECK(squared_distance_to_segment(a, b, {5, 5}) == 0);
    CHECK(squared_distance_to_segment(a, b, {1, -1}) == 9);    // beyond a
    CHECK(squared_distance_to_segment(a, b, {12, 12}) == 25);  // beyond b
    CHECK(squared_distance_to_segment(a, a, {4, 6}) == 25);
}

TEST_CASE("a bounding box contains its points and nothing more") {
    Box2 box;
    CHECK(box.size() == -std::numeric_limits<double>::infinity());  // empty
    box.add({3, -1});
    CHECK((box.low == Point2{3, -1} && box.high == Point2{3, -1} && box.size() == 0));
    box.add({-2, 5});
    box.add({0, 0});
    CHECK((box.low == Point2{-2, -1} && box.high == Point2{3, 5}));
    CHECK((box.width() == 5 && box.height() == 6 && box.size() == 6));
    const Box2 wider = box.expanded(0.5);
    CHECK((wider.low == Point2{-2.5, -1.5} && wider.high == Point2{3.5, 5.5}));
    const Box2 same = bounding_box(Triangle2{Point2{3, -1}, {-2, 5}, {0, 0}});
    CHECK((same.low == box.low && same.high == box.high));
}
