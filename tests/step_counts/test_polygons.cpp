// The work of triangulating large polygons, whose sources are compiled into this program with instrumentation.

#include <cmath>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "asset/scene/triangulate.hpp"
#include "step_counts/steps.hpp"
#include "support/catch.hpp"

using namespace faqem;

namespace {

using Ring = std::vector<Vec3>;
constexpr double pi = 3.14159265358979323846;

Vec3 polar(double radius, double angle) { return {radius * std::cos(angle), radius * std::sin(angle), 0}; }

Ring circle(int n) {
    Ring ring;
    for (int i = 0; i < n; ++i) ring.push_back(polar(1, 2 * pi * i / n));
    return ring;
}

Ring star(int n) {
    Ring ring;
    std::mt19937 random(1);
    for (int i = 0; i < n; ++i) ring.push_back(polar(0.2 + random() % 1000 / 1000.0, 2 * pi * i / n));
    return ring;
}

Ring comb(int n) {
    Ring ring = {{0, 0, 0}, {double(n - 3), 0, 0}};
    for (int i = n - 3; i >= 0; --i) ring.push_back({double(i), i % 2 ? 1.0 : 10.0, 0});
    return ring;
}

Ring slanted_comb(int n) {
    Ring ring = comb(n);
    for (Vec3& p : ring) p = {0.1 * p[0] + 0.7 * p[1], 0.1 * p[1] - 0.7 * p[0], 0};
    return ring;
}

Ring spiral(int n) {
    Ring outer, inner;
    for (int i = 0; i < n / 2; ++i) {
        outer.push_back(polar(2 + 0.1 * i, 0.1 * i));
        inner.push_back(polar(1 + 0.1 * i, 0.1 * i));
    }
    outer.insert(outer.end(), inner.rbegin(), inner.rend());
    return outer;
}

Ring square_with_collinear_corners(int n) {
    Ring ring;
    for (int i = 0; i < n; ++i) {
        const double t = i % (n / 4), side = n / 4;
        ring.push_back(std::array{Vec3{t, 0, 0}, Vec3{side, t, 0}, Vec3{side - t, side, 0},
                                  Vec3{0, side - t, 0}}[std::size_t(4 * i / n)]);
    }
    return ring;
}

Ring random_points(int n) {
    Ring ring;
    std::mt19937 random(2);
    for (int i = 0; i < n; ++i) ring.push_back({double(random() % 1000), double(random() % 1000), 0});
    return ring;
}

// All corners but one are in a small part of the bounding box.
Ring random_points_and_distant_point(int n) {
    Ring ring = random_points(n);
    ring[0] = {1e8, 1e8, 0};
    return ring;
}

// A third of the corners are at one position.
Ring petals(int n) {
    Ring ring;
    for (int i = 0; i < n / 3; ++i)
        for (const Vec3& p : {Vec3{0, 0, 0}, polar(1, 6 * pi * i / n), polar(1, 6 * pi * (i + 0.5) / n)})
            ring.push_back(p);
    return ring;
}

// Each position occurs four times in a row.
Ring repeated_points(int n) {
    Ring ring;
    for (int i = 0; i < n; ++i) ring.push_back(polar((i / 4) % 2 ? 1 : 0.6, 2 * pi * (i / 4) / (n / 4)));
    return ring;
}

Ring points_on_a_circle(int n) {
    Ring ring;
    std::mt19937 random(3);
    for (int i = 0; i < n; ++i) ring.push_back(polar(1, 2 * pi * (random() % 1000000) / 1e6));
    return ring;
}

double steps(const Ring& ring) {
    std::vector<Triangle> triangles;
    const std::uint64_t before = test::steps();
    detail::triangulate(ring, triangles);
    CHECK(triangles.size() == ring.size() - 2);
    return static_cast<double>(test::steps() - before);
}

}  // namespace

TEST_CASE("polygons: twice the corners need at most 2.4 times the work") {
    const std::vector<std::pair<std::string, Ring (*)(int)>> shapes = {
        {"convex", &circle},
        {"comb", &comb},
        {"slanted comb", &slanted_comb},
        {"spiral", &spiral},
        {"collinear corners", &square_with_collinear_corners},
        {"self-intersecting", &random_points},
        {"self-intersecting, clustered", &random_points_and_distant_point},
        {"petals", &petals},
        {"repeated points", &repeated_points},
        {"points on a circle", &points_on_a_circle}};
    for (const auto& [name, shape] : shapes) {
        INFO(name);
        const double once = steps(shape(6000)), twice = steps(shape(12000)), four_times = steps(shape(24000));
        CHECK(twice < 2.4 * once);
        CHECK(four_times < 2.4 * twice);
    }
}

// The narrow triangles of the spikes have many corners near their long sides.
TEST_CASE("polygons: a star of twice the random spikes needs at most 2.9 times the work") {
    const double once = steps(star(6000)), twice = steps(star(12000)), four_times = steps(star(24000));
    CHECK(twice < 2.9 * once);
    CHECK(four_times < 2.9 * twice);
}
