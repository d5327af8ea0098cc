#include "faqem/engine/tracking/distance.hpp"

#include <algorithm>
#include <limits>
#include <vector>

#include "faqem/detail/geometry/triangle.hpp"
#include "support/catch.hpp"
#include "support/meshes.hpp"

using namespace faqem;
using engine::TriangleDistance;
using engine::Vector3;

TEST_CASE("distance: the nearest point of a triangle is inside, on a side or a corner") {
    const TriangleDistance triangle({0, 0, 0}, {4, 0, 0}, {0, 3, 0});
    CHECK(triangle({1, 1, 2}) == Approx(4));
    CHECK(triangle({1, -2, 0}) == Approx(4));
    CHECK(triangle({-3, -4, 0}) == Approx(25));
    CHECK(triangle({7, 0, 4}) == Approx(25));
    CHECK(triangle({4, 3, 0}) == Approx(2.4 * 2.4));  // the height above the hypotenuse
}

TEST_CASE("distance: agrees with the closest point, also for slivers, segments and points") {
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

TEST_CASE("distance: the nearest of several triangles is found, the first of equal ones") {
    const Vector3 a(0, 0, 0), b(1, 0, 0), c(0, 1, 0), up(0, 0, 1);
    const std::vector<TriangleDistance> layers = {
        {a, b, c}, {a + up, b + up, c + up}, {a + up, b + up, c + up}};
    engine::PointBatches points;
    std::vector<std::size_t> expected, found;
    for (int i = 0; i < 19; ++i) {
        points.add({0.2, 0.2, i % 3 == 0 ? 0.4 : 0.6});
        expected.push_back(i % 3 == 0 ? 0 : 1);
    }
    for_each_nearest(points, layers, [&](std::size_t i, std::size_t k) {
        CHECK(i == found.size());
        found.push_back(k);
    });
    CHECK(found == expected);
}

TEST_CASE("distance: batches of points agree with single points") {
    test::Random random(9);
    const auto point = [&] { return Vector3(random.unit(), random.unit(), random.unit()); };
    for (std::size_t count = 0; count < 40; ++count) {
        std::vector<TriangleDistance> triangles;
        for (std::size_t k = 0; k < 1 + count % 7; ++k) triangles.emplace_back(point(), point(), point());
        engine::PointBatches points;
        const Vector3 centre = point();
        double farthest = 0, nearest_to_centre = std::numeric_limits<double>::infinity();
        for (std::size_t i = 0; i < count; ++i) {
            const Vector3 p = 2 * point();
            points.add(p);
            double nearest = std::numeric_limits<double>::infinity();
            for (const TriangleDistance& distance : triangles) nearest = std::min(nearest, distance(p));
            farthest = std::max(farthest, nearest);
            nearest_to_centre = std::min(nearest_to_centre, (p - centre).squaredNorm());
        }
        CHECK(farthest_squared(points, triangles, 0.0) == farthest);
        CHECK(farthest_squared(points, triangles, 0.01) == std::max(0.01, farthest));
        const auto [squared, at] = points.nearest(centre);
        CHECK(squared == Approx(nearest_to_centre));
        CHECK((at < count) == (count > 0));
    }
}

TEST_CASE("distance: a segment is equivalent to a triangle with two equal corners") {
    test::Random random(5);
    const auto point = [&] { return Vector3(random.unit(), random.unit(), random.unit()); };
    for (int i = 0; i < 500; ++i) {
        const Vector3 a = point(), b = i % 5 == 0 ? a : point(), p = 3 * point();
        CHECK(engine::SegmentDistance(a, b)(p) == Approx(TriangleDistance(a, b, b)(p)));
    }
}

TEST_CASE("distance: the farthest point has the largest distance from its nearest segment") {
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
