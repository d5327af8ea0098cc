#include "faqem/detail/geometry/bvh.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include "support/catch.hpp"
#include "support/meshes.hpp"

using faqem::Index;
using faqem::no_index;
using faqem::Triangle;
using faqem::Vec3;
using faqem::detail::Bvh;
using faqem::detail::closest_point_on_triangle;
using faqem::detail::ClosestPoint;
using faqem::engine::Vector3;

namespace {

// The triangle of most tests:
//
//     c (0,2,0)
//     | \       Its interior, edges and corners are queried from above
//     |   \     (height 3) and from the sides.
//     a --- b (4,0,0)
const Vector3 corner_a(0, 0, 0), corner_b(4, 0, 0), corner_c(0, 2, 0);

void check_consistent(const ClosestPoint& hit, const Vector3& p, const Vector3& x, const Vector3& y,
                      const Vector3& z) {
    CHECK(hit.barycentric.minCoeff() >= 0);
    CHECK(hit.barycentric.sum() == Approx(1));
    const Vector3 mixed = hit.barycentric[0] * x + hit.barycentric[1] * y + hit.barycentric[2] * z;
    CHECK((mixed - hit.point).norm() <= 1e-12 * (1 + mixed.norm()));
    CHECK(hit.distance_squared == Approx((p - hit.point).squaredNorm()));
}

ClosestPoint query(const Vector3& p, const Vector3& x = corner_a, const Vector3& y = corner_b,
                   const Vector3& z = corner_c) {
    const ClosestPoint hit = closest_point_on_triangle(p, x, y, z);
    check_consistent(hit, p, x, y, z);
    return hit;
}

/// Random triangles of very different sizes in the unit cube, a fifth of them degenerate.
struct Soup {
    std::vector<Vec3> positions;
    std::vector<Triangle> triangles;

    explicit Soup(std::size_t faces, unsigned seed) {
        std::mt19937 engine(seed);
        const auto unit = [&] { return engine() / 4294967296.0; };
        for (std::size_t f = 0; f < faces; ++f) {
            const double size = std::pow(10.0, -3 * unit());
            const Vec3 centre = {unit(), unit(), unit()};
            const auto first = static_cast<Index>(positions.size());
            for (int k = 0; k < 3; ++k) {
                Vec3 p = centre;
                for (double& x : p) x += size * (unit() - 0.5);
                positions.push_back(p);
            }
            if (f % 10 == 3) positions.back() = positions[first];
            if (f % 10 == 7) positions[first + 1] = positions[first + 2] = positions[first];
            triangles.push_back({first, first + 1, first + 2});
        }
    }

    ClosestPoint on(Index f, const Vec3& p) const {
        const auto corner = [&](int k) {
            return faqem::engine::to_eigen(positions[triangles[f][static_cast<std::size_t>(k)]]);
        };
        return closest_point_on_triangle(faqem::engine::to_eigen(p), corner(0), corner(1), corner(2));
    }
};

}  // namespace

TEST_CASE("closest point on a triangle: each Voronoi region") {
    CHECK(query({1, 0.5, 3}).point == Vector3(1, 0.5, 0));
    CHECK(query({1, 0.5, 3}).distance_squared == 9);
    CHECK(query({-1, -2, 0}).point == corner_a);
    CHECK(query({6, -1, 2}).point == corner_b);
    CHECK(query({-1, 5, 0}).point == corner_c);
    CHECK(query({2, -3, 1}).point.isApprox(Vector3(2, 0, 0)));
    CHECK(query({-3, 1, 1}).point.isApprox(Vector3(0, 1, 0)));
    // Beyond bc, whose normal is (1, 2), in front of its midpoint (2, 1).
    CHECK(query({2 + 1, 1 + 2, 0}).point.isApprox(Vector3(2, 1, 0)));
}

TEST_CASE("closest point on a triangle: a corner is returned bitwise exactly") {
    const Vector3 x(0.1, 0.2, 0.3), y(1.7, 0.2, 0.9), z(0.3, 2.1, 1e-3);
    for (const Vector3& corner : {x, y, z}) {
        const Vector3 centre = (x + y + z) / 3;
        const ClosestPoint hit = query(corner + 5 * (corner - centre), x, y, z);
        CHECK(hit.point == corner);
        CHECK(hit.barycentric.maxCoeff() == 1);
    }
}

TEST_CASE("closest point on a triangle: degenerate triangles count as segments or points") {
    CHECK(query({1, 2, 0}, corner_a, corner_b, corner_b).point.isApprox(Vector3(1, 0, 0)));
    CHECK(query({1, 2, 0}, corner_b, corner_a, Vector3(2, 0, 0)).point.isApprox(Vector3(1, 0, 0)));
    CHECK(query({1, 2, 0}, corner_a, corner_a, corner_a).point == corner_a);
    CHECK(query({1, 2, 2}, corner_a, corner_a, corner_a).distance_squared == 9);
    CHECK(query({5, 1, 0}, corner_a, Vector3(1, 0, 0), corner_b).point == corner_b);
}

TEST_CASE("closest point on a triangle: needles are handled without loss of accuracy") {
    // Height 1e-12 over a base of 1: the formula for interior points has no correct digits here.
    const Vector3 x(1, 1, 1), y(2, 1, 1), z(1.5, 1 + 1e-12, 1);
    for (int i = 1; i < 50; ++i) {
        const double s = i / 50.0;
        const ClosestPoint hit = query({1 + s, 3, 1.5}, x, y, z);
        CHECK(hit.point.x() == Approx(1 + s).margin(1e-9));
        CHECK(hit.distance_squared == Approx(4.25).epsilon(1e-10));
    }
}

TEST_CASE("BVH: closest() agrees with brute force") {
    for (const std::size_t faces : {1u, 2u, 5u, 17u, 1000u}) {
        const Soup soup(faces, 7);
        const Bvh tree(soup.positions, soup.triangles);
        std::mt19937 engine(11);
        for (int i = 0; i < 300; ++i) {
            const double scale = i % 3 == 0 ? 10 : 1;
            const Vec3 p = {scale * engine() / 4294967296.0, scale * engine() / 4294967296.0,
                            scale * engine() / 4294967296.0};
            double best = std::numeric_limits<double>::infinity();
            for (Index f = 0; f < faces; ++f) best = std::min(best, soup.on(f, p).distance_squared);
            const Bvh::Hit hit = tree.closest(p);
            REQUIRE(hit.face < faces);
            CHECK(hit.distance_squared == best);
            CHECK(soup.on(hit.face, p).distance_squared == best);
            CHECK(hit.point == faqem::engine::to_array(soup.on(hit.face, p).point));
        }
    }
}

TEST_CASE("BVH: among equally close faces, closest() returns the one with the smallest index") {
    const Index n = 12;
    faqem::TriangleMesh mesh = faqem::test::grid(n);
    // Every face is duplicated.
    const std::vector<Triangle> copies = mesh.triangles;
    mesh.triangles.insert(mesh.triangles.end(), copies.begin(), copies.end());
    const Bvh tree(mesh.positions, mesh.triangles);
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
        Index first = 0;
        const auto has = [&](Index f) {
            const Triangle& t = mesh.triangles[f];
            return t[0] == v || t[1] == v || t[2] == v;
        };
        while (!has(first)) ++first;
        Vec3 above = mesh.positions[v];
        above[2] = 5;
        CHECK(tree.closest(above).face == first);
    }
}

TEST_CASE("BVH: closest_if() ignores faces that the filter rejects") {
    const Soup soup(400, 3);
    const Bvh tree(soup.positions, soup.triangles);
    const Vec3 p = {0.5, 0.4, 0.6};
    for (Index modulus = 2; modulus < 9; ++modulus) {
        const auto allowed = [&](Index f) { return f % modulus == 1; };
        double best = std::numeric_limits<double>::infinity();
        for (Index f = 0; f < 400; ++f) {
            if (allowed(f)) best = std::min(best, soup.on(f, p).distance_squared);
        }
        const Bvh::Hit hit = tree.closest_if(p, [&](const Bvh::Corners& t) { return allowed(t.face); });
        CHECK(allowed(hit.face));
        CHECK(hit.distance_squared == best);
    }
    CHECK(tree.closest_if(p, [](const Bvh::Corners&) { return false; }).face == no_index);
}

TEST_CASE("BVH: closest_if() stops after the maximum number of rejections") {
    const Soup soup(400, 3);
    const Bvh tree(soup.positions, soup.triangles);
    const Vec3 p = {0.5, 0.4, 0.6};
    constexpr double anywhere = std::numeric_limits<double>::infinity();
    for (std::size_t max_rejections = 0; max_rejections < 40; ++max_rejections) {
        std::size_t calls = 0;
        const auto reject_all = [&](const Bvh::Corners&) { return ++calls, false; };
        CHECK(tree.closest_if(p, reject_all, anywhere, max_rejections).face == no_index);
        CHECK(calls == max_rejections);
    }
    const Index nearest = tree.closest(p).face;
    const auto all_but_nearest = [&](const Bvh::Corners& t) { return t.face != nearest; };
    CHECK(tree.closest_if(p, all_but_nearest, anywhere, 2).distance_squared ==
          tree.closest_if(p, all_but_nearest).distance_squared);
}

TEST_CASE("BVH: the maximum distance of closest() is inclusive") {
    const std::vector<Vec3> positions = {{0, 0, 0}, {4, 0, 0}, {0, 2, 0}};
    const std::vector<Triangle> triangles = {{0, 1, 2}};
    const Bvh tree(positions, triangles);
    CHECK(tree.closest({1, 0.5, 3}, 9).face == 0);
    CHECK(tree.closest({1, 0.5, 3}, 8.999).face == no_index);
}

TEST_CASE("BVH: visit_within() visits each face within the distance once") {
    const Soup soup(500, 5);
    const Bvh tree(soup.positions, soup.triangles);
    const Vec3 p = {0.5, 0.5, 0.5};
    std::vector<int> visits(500, 0);
    tree.visit_within(p, 0.04, [&](Index f, const ClosestPoint& hit) {
        ++visits[f];
        CHECK(hit.distance_squared == soup.on(f, p).distance_squared);
    });
    for (Index f = 0; f < 500; ++f) CHECK(visits[f] == (soup.on(f, p).distance_squared <= 0.04 ? 1 : 0));
}

TEST_CASE("BVH: any_hit() finds triangles in front of the ray and reports the side that is hit") {
    const std::vector<Vec3> positions = {{0, 0, 0}, {4, 0, 0}, {0, 2, 0}};
    const std::vector<Triangle> triangles = {{0, 1, 2}};
    const Bvh tree(positions, triangles);
    std::vector<Bvh::Side> sides;
    const auto seen = [&](Index f, Bvh::Side side) {
        CHECK(f == 0);
        sides.push_back(side);
        return true;
    };
    CHECK(tree.any_hit({1, 0.5, 3}, {0, 0, -1}, seen));
    CHECK(tree.any_hit({1, 0.5, -3}, {0, 0, 1}, seen));
    CHECK(sides == std::vector{Bvh::Side::front, Bvh::Side::back});
    CHECK(tree.any_hit({0, 0, 1}, {0, 0, -1}, seen));          // a corner
    CHECK(tree.any_hit({2, 0, 1}, {0, 0, -1}, seen));          // an edge
    CHECK_FALSE(tree.any_hit({1, 0.5, 3}, {0, 0, 1}, seen));   // behind it
    CHECK_FALSE(tree.any_hit({3, 1.5, 3}, {0, 0, -1}, seen));  // beside it
    CHECK_FALSE(tree.any_hit({-1, 0.5, 0}, {1, 0, 0}, seen));  // in its plane
    CHECK_FALSE(tree.any_hit({1, 0.5, 3}, {0, 0, -1}, [](Index, Bvh::Side) { return false; }));
    CHECK_FALSE(Bvh().any_hit({0, 0, 0}, {0, 0, 1}, seen));
}

TEST_CASE("BVH: any_hit() agrees with brute force") {
    for (const std::size_t faces : {1u, 5u, 17u, 1000u}) {
        const Soup soup(faces, 7);
        const Bvh tree(soup.positions, soup.triangles);
        std::mt19937 engine(11);
        const auto unit = [&] { return engine() / 4294967296.0; };
        std::size_t met = 0;
        for (int i = 0; i < 300; ++i) {
            const Vector3 origin(unit(), unit(), unit());
            Vector3 direction = Vector3(unit() - 0.5, unit() - 0.5, unit() - 0.5).normalized();
            if (i % 3 == 0) direction = i % 2 ? Vector3(0, 0, -1) : Vector3(0, 1, 0);
            std::vector<int> expected(faces, 0), found(faces, 0);
            for (Index f = 0; f < faces; ++f) {
                // The intersection with the plane is inside if it is on the inner side of all three edges.
                const auto corner = [&](std::size_t k) {
                    return faqem::engine::to_eigen(soup.positions[soup.triangles[f][k]]);
                };
                const Vector3 normal = (corner(1) - corner(0)).cross(corner(2) - corner(0));
                const double slope = normal.dot(direction), t = normal.dot(corner(0) - origin) / slope;
                if (!(std::abs(slope) > 0 && t > 0)) continue;
                const Vector3 p = origin + t * direction;
                bool inside = true;
                for (std::size_t k = 0; k < 3; ++k)
                    inside =
                        inside && (corner((k + 1) % 3) - corner(k)).cross(p - corner(k)).dot(normal) >= 0;
                if (inside) expected[f] = slope < 0 ? 1 : 2;
            }
            const bool any = tree.any_hit(faqem::engine::to_array(origin), faqem::engine::to_array(direction),
                                          [&](Index f, Bvh::Side side) {
                                              found[f] = side == Bvh::Side::front ? 1 : 2;
                                              return false;
                                          });
            CHECK_FALSE(any);
            CHECK(found == expected);
            met += static_cast<std::size_t>(std::count(found.begin(), found.end(), 0)) < faces;
        }
        CHECK((faces < 1000 || met > 150));
    }
}

TEST_CASE("BVH: trees without faces and of removed faces only are empty") {
    CHECK(Bvh(std::span<const Vec3>(), {}).closest({0, 0, 0}).face == no_index);
    const std::vector<Triangle> dropped = {{no_index, no_index, no_index}};
    CHECK(Bvh(std::span<const Vec3>(), dropped).empty());
}

TEST_CASE("BVH: coincident and exponentially spaced faces give a tree of bounded depth") {
    Soup soup(0, 0);
    const std::vector<Vec3> corner = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    for (int i = 0; i < 3000; ++i) {
        // Sizes 2^-i down to the smallest subnormal number; all further faces are coincident.
        const double scale = std::ldexp(1.0, -std::min(i, 1074));
        const auto first = static_cast<Index>(soup.positions.size());
        for (const Vec3& p : corner) soup.positions.push_back({scale * p[0], scale * p[1], scale * p[2]});
        soup.triangles.push_back({first, first + 1, first + 2});
    }
    const Bvh tree(soup.positions, soup.triangles);
    const Bvh::Hit hit = tree.closest({1, 1, 1});
    CHECK(hit.face == 0);
    CHECK(hit.distance_squared == Approx(4.0 / 3));
    CHECK(tree.closest({-1, -1, -1}).face < 3000);
}

TEST_CASE("BVH: coordinates over nearly the whole range of doubles are supported") {
    const double far = 1.7e308, side = 1e300;
    std::vector<Vec3> positions;
    std::vector<Triangle> triangles;
    for (const double x : {-far, -far / 2, 0.0, far / 2, far}) {
        const auto first = static_cast<Index>(positions.size());
        positions.insert(positions.end(), {{x, 0, 0}, {x, side, 0}, {x, 0, side}});
        triangles.push_back({first, first + 1, first + 2});
    }
    const Bvh tree(positions, triangles);
    for (Index f = 0; f < triangles.size(); ++f) {
        const auto hit = tree.closest(positions[triangles[f][0]]);
        CHECK(hit.face == f);
        CHECK(hit.distance_squared == 0);
    }
}

TEST_CASE("BVH: a refitted tree gives the same distances as a new one") {
    Soup soup(500, 5);
    std::vector<Vector3> positions;
    for (const Vec3& p : soup.positions) positions.push_back(faqem::engine::to_eigen(p));
    Bvh tree(positions, soup.triangles);
    for (std::size_t v = 0; v < positions.size(); ++v) {
        positions[v] = 2 * Vector3(positions[v].y(), positions[v].z(), positions[v].x());
        soup.positions[v] = faqem::engine::to_array(positions[v]);
    }
    tree.refit(positions, soup.triangles);
    const Bvh rebuilt(positions, soup.triangles);
    for (std::size_t v = 0; v < positions.size(); v += 7) {
        const Vec3 p = faqem::engine::to_array(0.9 * positions[v] + Vector3(0.1, 0, 0));
        CHECK(tree.closest(p).distance_squared == Approx(rebuilt.closest(p).distance_squared).margin(1e-30));
        const auto near = static_cast<Index>(soup.triangles.size() - 1 - v / 3);
        const auto [a0, b0, c0] = soup.triangles[near];
        CHECK(tree.closest_with_hint(p, near, positions[a0], positions[b0], positions[c0]).distance_squared ==
              tree.closest(p).distance_squared);
    }
}
