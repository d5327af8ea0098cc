#include "faqem/engine/tracking/distance.hpp"

#include <catch2/catch.hpp>

#include "faqem/detail/geometry/triangle.hpp"
#include "support/meshes.hpp"

using namespace faqem;
using engine::TriangleDistance;
using engine::Vector3;

TEST_CASE("distance: inside, beyond a side and beyond a corner of a right triangle") {
    const TriangleDistance triangle({0, 0, 0}, {4, 0, 0}, {0, 3, 0});
    CHECK(triangle({1, 1, 2}) == Approx(4));
    CHECK(triangle({1, -2, 0}) == Approx(4));
    CHECK(triangle({-3, -4, 0}) == Approx(25));
    CHECK(triangle({7, 0, 4}) == Approx(25));
    CHECK(triangle({4, 3, 0}) == Approx(2.4 * 2.4));  // the height over the hypotenuse
}

TEST_CASE("distance: it is that of the closest point, on slivers, segments and points too") {
    test::Random random(3);
    const auto point = [&] { return Vector3(random.unit(), random.unit(), random.unit()); };
    for (int i = 0; i < 2000; ++i) {
        const Vector3 a = point();
        Vector3 b = point(), c = point();
        if (i % 4 == 1) c = a + random.unit() * (b - a) + 1e-6 * point();
        if (i % 4 == 2) c = a + 2 * random.unit() * (b - a);
        if (i % 4 == 3) b = c = a;
        const TriangleDistance distance(a, b, c);
        for (int k = 0; k < 20; ++k) {
            const Vector3 p = 3 * point();
            const double expected = detail::closest_point_on_triangle(p, a, b, c).distance_squared;
            REQUIRE(distance(p) == Approx(expected).epsilon(1e-7).margin(1e-12));
        }
    }
}

TEST_CASE("distance: of several triangles the nearest is found, the first of equals") {
    const Vector3 a(0, 0, 0), b(1, 0, 0), c(0, 1, 0), up(0, 0, 1);
    const std::vector<TriangleDistance> layers = {
        {a, b, c}, {a + up, b + up, c + up}, {a + up, b + up, c + up}};
    CHECK(engine::nearest_index(layers, {0.2, 0.2, 0.4}) == 0);
    CHECK(engine::nearest_index(layers, {0.2, 0.2, 0.6}) == 1);
    CHECK(engine::nearest_index(std::vector<TriangleDistance>(), a) == 0);
}

TEST_CASE(
    "distance: a segment's is that of the triangle with two equal corners, a point's that of the point") {
    test::Random random(5);
    const auto point = [&] { return Vector3(random.unit(), random.unit(), random.unit()); };
    for (int i = 0; i < 500; ++i) {
        const Vector3 a = point(), b = i % 5 == 0 ? a : point(), p = 3 * point();
        CHECK(engine::SegmentDistance(a, b)(p) == Approx(TriangleDistance(a, b, b)(p)));
    }
}

TEST_CASE("distance: the farthest point is that with the largest smallest distance, in any order") {
    test::Random random(7);
    const auto point = [&] { return Vector3(random.unit(), random.unit(), random.unit()); };
    for (int i = 0; i < 100; ++i) {
        std::vector<engine::SegmentDistance> segments;
        for (int k = 0; k < 1 + i % 9; ++k) segments.emplace_back(point(), point());
        engine::FarthestPoint farthest(segments);
        double expected = 0;
        for (int k = 0; k < i % 13; ++k) {
            const Vector3 p = 2 * point();
            farthest.add(p);
            expected = std::max(expected, segments[engine::nearest_index(segments, p)](p));
            CHECK(farthest.squared_distance() == expected);
        }
    }
}
