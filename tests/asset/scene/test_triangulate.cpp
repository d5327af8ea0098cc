#include <cmath>
#include <limits>
#include <map>
#include <random>

#include "asset/scene/triangulate.hpp"
#include "support/catch.hpp"

using namespace faqem;
using namespace faqem::detail;

namespace {

using Ring = std::vector<Vec3>;

/// A polygon in the plane z = 0.
Ring flat(std::initializer_list<std::array<double, 2>> points) {
    Ring ring;
    for (const auto& p : points) ring.push_back({p[0], p[1], 0});
    return ring;
}

double area(const Vec3& a, const Vec3& b, const Vec3& c) {
    return ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])) / 2;
}

double shoelace(const Ring& ring) {
    double sum = 0;
    for (std::size_t i = 0; i < ring.size(); ++i) {
        const Vec3 &a = ring[i], &b = ring[(i + 1) % ring.size()];
        sum += a[0] * b[1] - a[1] * b[0];
    }
    return sum / 2;
}

std::vector<Triangle> split(const Ring& ring) {
    std::vector<Triangle> triangles;
    triangulate(ring, triangles);
    return triangles;
}

/// Checks a triangulation of a simple polygon: n - 2 triangles with positive areas that sum to the area of
/// the polygon; each interior edge is used once in each direction, each polygon edge once.
void check_triangulation(const Ring& ring, double tolerance = 1e-12) {
    const std::vector<Triangle> triangles = split(ring);
    REQUIRE(triangles.size() == ring.size() - 2);
    double sum = 0;
    std::map<std::pair<Index, Index>, int> edges;
    bool all_positive = true;
    for (const Triangle& t : triangles) {
        const double a = area(ring[t[0]], ring[t[1]], ring[t[2]]);
        all_positive &= a > 0;
        sum += a;
        for (int k = 0; k < 3; ++k) ++edges[{t[k], t[(k + 1) % 3]}];
    }
    CHECK(all_positive);
    CHECK(sum == Approx(shoelace(ring)).epsilon(tolerance));
    bool consistent = true;
    for (const auto& [edge, count] : edges) {
        const bool on_ring = edge.second == (edge.first + 1) % ring.size();
        consistent &= count == 1 && (on_ring || edges.count({edge.second, edge.first}) == 1);
    }
    CHECK(consistent);
}

}  // namespace

TEST_CASE("a convex polygon becomes a fan around its first corner", "[polygon]") {
    CHECK(split(flat({{0, 0}, {1, 0}, {1, 1}, {0, 1}})) == std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}});
    Ring circle;
    for (int i = 0; i < 100; ++i) circle.push_back({std::cos(i * 0.0628), std::sin(i * 0.0628), 0});
    const std::vector<Triangle> fan = split(circle);
    for (Index i = 0; i < fan.size(); ++i) CHECK(fan[i] == Triangle{0, i + 1, i + 2});
}

//  3-------2
//   \  1'/      the reflex corner of the quad lies inside the fan of corner 0
TEST_CASE("concave quads are split along the inner diagonal", "[polygon]") {
    const Ring dart = flat({{0, 0}, {4, 0}, {1, 1}, {0, 4}});
    for (std::size_t shift = 0; shift < 4; ++shift) {
        Ring turned;
        for (std::size_t i = 0; i < 4; ++i) turned.push_back(dart[(i + shift) % 4]);
        check_triangulation(turned);
    }
}

TEST_CASE("combs, spirals and stars are triangulated without overlap", "[polygon]") {
    Ring comb = flat({{0, 0}, {20, 0}});
    for (int i = 20; i >= 0; --i) comb.push_back({double(i), i % 2 ? 1.0 : 10.0, 0});
    check_triangulation(comb);
    Ring star;
    for (int i = 0; i < 400; ++i) {
        const double r = i % 2 ? 1 : 0.1 + 0.01 * (i % 7), a = i * 2 * 3.14159265358979 / 400;
        star.push_back({r * std::cos(a), r * std::sin(a), 0});
    }
    check_triangulation(star);
    Ring spiral, back;
    for (int i = 0; i < 300; ++i) {
        const double a = i * 0.1;
        spiral.push_back({(1 + a) * std::cos(a), (1 + a) * std::sin(a), 0});
        back.push_back({(2 + a) * std::cos(a), (2 + a) * std::sin(a), 0});
    }
    Ring band(back);
    band.insert(band.end(), spiral.rbegin(), spiral.rend());
    if (shoelace(band) < 0) band.assign(band.rbegin(), band.rend());
    check_triangulation(band, 1e-9);
}

TEST_CASE("random star-shaped polygons are triangulated without overlap", "[polygon]") {
    std::mt19937 random(7);
    for (int round = 0; round < 50; ++round) {
        Ring ring;
        const int n = 4 + round;
        for (int i = 0; i < n; ++i) {
            const double r = 0.2 + random() % 1000 / 500.0, a = 2 * 3.14159265358979 * i / n;
            ring.push_back({r * std::cos(a), r * std::sin(a), 0});
        }
        CAPTURE(round);
        check_triangulation(ring);
    }
}

TEST_CASE("collinear corners do not give degenerate triangles", "[polygon]") {
    check_triangulation(flat({{0, 0}, {1, 0}, {2, 0}, {2, 1}, {2, 2}, {1, 2}, {0, 2}, {0, 1}}));
    check_triangulation(flat({{0, 0}, {1, 0}, {2, 0}, {1, 2}}));
}

// An outer and an inner square, connected by a bridge edge that is traversed twice.
TEST_CASE("a hole connected by a bridge edge is kept", "[polygon]") {
    check_triangulation(
        flat({{0, 0}, {6, 0}, {6, 6}, {0, 6}, {0, 0}, {2, 2}, {2, 4}, {4, 4}, {4, 2}, {2, 2}}));
}

TEST_CASE("the triangulation is independent of the plane and the scale of the polygon", "[polygon]") {
    const Ring flat_l = flat({{0, 0}, {3, 0}, {3, 1}, {1, 1}, {1, 3}, {0, 3}});
    const std::vector<Triangle> expected = split(flat_l);
    for (const double scale : {1e-160, 1e-30, 1.0, 1e30, 1e150})
        for (int axis = 0; axis < 3; ++axis) {
            CAPTURE(scale, axis);
            Ring moved;
            for (const Vec3& p : flat_l) {
                Vec3 q;
                q[(axis + 1) % 3] = p[0] * scale;
                q[(axis + 2) % 3] = p[1] * scale;
                q[axis] = 0.5 * scale;
                moved.push_back(q);
            }
            CHECK(split(moved) == expected);
        }
}

TEST_CASE("triangulation keeps the winding", "[polygon]") {
    const Ring l = flat({{0, 0}, {3, 0}, {3, 1}, {1, 1}, {1, 3}, {0, 3}});
    const Ring turned(l.rbegin(), l.rend());
    double sum = 0;
    for (const Triangle& t : split(turned)) {
        const double a = area(turned[t[0]], turned[t[1]], turned[t[2]]);
        CHECK(a < 0);
        sum += a;
    }
    CHECK(sum == Approx(-5));
}

TEST_CASE("any polygon of n corners gives n - 2 triangles with valid corners", "[polygon]") {
    const double nan = std::numeric_limits<double>::quiet_NaN(),
                 inf = std::numeric_limits<double>::infinity();
    std::vector<Ring> rings = {
        flat({{0, 0}, {1, 1}, {1, 0}, {0, 1}}),                          // bow-tie
        flat({{0, 0}, {0, 0}, {0, 0}, {0, 0}, {0, 0}}),                  // one point
        flat({{0, 0}, {1, 0}, {2, 0}, {3, 0}, {1.5, 0}}),                // a line
        flat({{0, 0}, {1, nan}, {1, 1}, {0, 1}}),                        //
        flat({{0, 0}, {inf, 0}, {1, 1}, {0.2, 0.1}}),                    //
        flat({{-1.7e308, 0}, {1.7e308, 0}, {0, 1.7e308}, {0, 1e308}})};  // differences overflow
    std::mt19937 random(3);
    for (int round = 0; round < 30; ++round) {
        Ring scribble;
        for (int i = 0; i < 200; ++i) scribble.push_back({double(random() % 50), double(random() % 50), 0});
        rings.push_back(scribble);
    }
    for (const Ring& ring : rings) {
        const std::vector<Triangle> triangles = split(ring);
        CHECK(triangles.size() == ring.size() - 2);
        for (const Triangle& t : triangles)
            for (const Index i : t) CHECK(i < ring.size());
    }
    CHECK(split(flat({{0, 0}, {1, 0}})).empty());
    CHECK(split({}).empty());
}

TEST_CASE("a comb of 60000 corners is triangulated", "[polygon]") {
    Ring comb = flat({{0, 0}, {60000, 0}});
    for (int i = 60000; i >= 0; --i) comb.push_back({double(i), i % 2 ? 1.0 : 10.0, 0});
    check_triangulation(comb, 1e-9);
}

TEST_CASE("polygons keep their order and unusable ones are counted", "[polygon]") {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const std::vector<Vec3> positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {nan, 0, 0}};
    Polygons polygons;
    polygons.vertices = {0, 1, /**/ 0, 1, 2, 3, /**/ 1, 2, 3, 4, /**/ 3, 2, 1};
    polygons.sizes = {2, 4, 4, 3};
    const TriangulatedPolygons result = triangulate_polygons(polygons, positions);
    CHECK(result.triangles == std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}, {3, 2, 1}});
    CHECK(result.source_polygon == std::vector<Index>{1, 1, 3});
    CHECK(result.too_few_corners == 1);
    CHECK(result.non_finite == 1);
}
