#include "faqem/detail/geometry/near_triangles.hpp"

#include <cmath>

#include "support/catch.hpp"
#include "support/meshes.hpp"

using faqem::Index;
using faqem::detail::closest_point_on_triangle;
using faqem::detail::ClosestPoint;
using faqem::detail::NearTriangles;
using faqem::engine::Vector3;
using faqem::test::Random;

namespace {

// In the unit cube around the origin.
Vector3 random_point(Random& random) {
    const double x = random.unit() - 0.5, y = random.unit() - 0.5, z = random.unit() - 0.5;
    return {x, y, z};
}

// Triangles of sizes from 0.01 to 100 around a point; every sixth is a segment, a point or a needle.
std::vector<NearTriangles::Entry> soup(Random& random, std::size_t count, const Vector3& around,
                                       double scale) {
    std::vector<NearTriangles::Entry> result;
    for (std::size_t i = 0; i < count; ++i) {
        const double size = std::pow(10.0, 4 * random.unit() - 2);
        const Vector3 a = around + scale * random_point(random), b = a + scale * size * random_point(random);
        Vector3 c = a + scale * size * random_point(random);
        if (i % 6 == 0) c = i % 12 == 0 ? a : Vector3(a + 0.3 * (b - a) + 1e-7 * (c - a));
        result.push_back({a, i % 24 == 0 ? a : b, c, static_cast<Index>(1000 - 7 * i)});
    }
    return result;
}

// The closest triangle, evaluating all.
NearTriangles::Hit brute_force(const std::vector<NearTriangles::Entry>& all, const Vector3& p) {
    NearTriangles::Hit best;
    for (const NearTriangles::Entry& e : all) {
        const ClosestPoint at = closest_point_on_triangle(p, e.a, e.b, e.c);
        if (at.distance_squared < best.at.distance_squared ||
            (at.distance_squared == best.at.distance_squared && e.face < best.entry->face))
            best = {&e, at};
    }
    return best;
}

// The triangles within a distance of a point.
std::vector<NearTriangles::Entry> within(const std::vector<NearTriangles::Entry>& all, const Vector3& centre,
                                         double reach) {
    std::vector<NearTriangles::Entry> result;
    for (const NearTriangles::Entry& e : all)
        if (closest_point_on_triangle(centre, e.a, e.b, e.c).distance_squared <= reach * reach)
            result.push_back(e);
    return result;
}

}  // namespace

TEST_CASE("near triangles: a result is that of all triangles, bit by bit") {
    Random random(7);
    std::size_t found = 0, queries = 0;
    for (const double scale : {1.0, 1e-12, 1e12}) {
        for (const double offset : {0.0, 1e3, 1e9}) {
            for (int repetition = 0; repetition < 30; ++repetition) {
                const Vector3 around = Vector3(1, -2, 3) * offset * scale;
                const auto all = soup(random, 40, around, scale);
                const Vector3 centre = around + scale * random_point(random);
                const double radius = 0.1 * scale;
                const double reach = std::sqrt(brute_force(all, centre).at.distance_squared) + 2 * radius;
                NearTriangles near;
                near.reset(centre, reach, within(all, centre, reach));
                NearTriangles::Recent recent;
                for (int i = 0; i < 20; ++i, ++queries) {
                    const Vector3 p = centre + 1.1 * radius * random_point(random);
                    const auto hit = near.closest(p);
                    const auto same = near.closest(p, recent);
                    REQUIRE(same.has_value() == hit.has_value());
                    if (!hit) continue;
                    ++found;
                    const NearTriangles::Hit best = brute_force(all, p);
                    CHECK(hit->entry->face == best.entry->face);
                    CHECK(hit->at.distance_squared == best.at.distance_squared);
                    CHECK(hit->at.barycentric == best.at.barycentric);
                    CHECK(same->entry == hit->entry);
                    CHECK(same->at.barycentric == hit->at.barycentric);
                }
            }
        }
    }
    CHECK(found > queries * 9 / 10);
}

TEST_CASE("near triangles: the result is the same where the triangle found before is certainly the closest") {
    const std::vector<NearTriangles::Entry> strip = {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 3},
                                                     {{1, 0, 0}, {1, 1, 0}, {0, 1, 0}, 2}};
    NearTriangles near;
    near.reset({0.5, 0.5, 0}, 2, strip);
    NearTriangles::Recent recent;
    std::size_t unchanged = 0;
    for (int i = 0; i <= 100; ++i) {
        const Vector3 p(0.01 * i, 0.01 * i, 0.1);
        const NearTriangles::Recent before = recent;
        const auto hit = near.closest(p, recent);
        REQUIRE(hit);
        CHECK(hit->entry->face == (i < 50 ? 3u : 2u));
        CHECK(hit->at.distance_squared == brute_force(strip, p).at.distance_squared);
        if (recent.at == before.at && i > 0) ++unchanged;
    }
    CHECK(unchanged > 50);
    CHECK(recent.others > 0);
}

TEST_CASE("near triangles: a projection is the closest point where there is one, up to rounding") {
    Random random(11);
    std::size_t found = 0, queries = 0;
    for (const double scale : {1.0, 1e-12, 1e12}) {
        // A rough surface of 14 x 14 squares with a side of 0.1.
        constexpr std::size_t n = 14;
        std::vector<Vector3> points;
        for (std::size_t i = 0; i <= n; ++i)
            for (std::size_t j = 0; j <= n; ++j)
                points.emplace_back(scale * Vector3(0.1 * i - 0.7, 0.1 * j - 0.7, 0.05 * random.unit()));
        std::vector<NearTriangles::Entry> all;
        for (std::size_t i = 0; i < n; ++i) {
            for (std::size_t j = 0; j < n; ++j) {
                const std::size_t at = i * (n + 1) + j;
                const auto face = static_cast<Index>(all.size());
                all.push_back({points[at], points[at + n + 1], points[at + 1], face});
                all.push_back({points[at + 1], points[at + n + 1], points[at + n + 2], face + 1});
            }
        }
        NearTriangles near;
        near.reset(Vector3::Zero(), 0.5 * scale, within(all, Vector3::Zero(), 0.5 * scale));
        REQUIRE_FALSE(near.empty());
        NearTriangles::Recent recent;
        CHECK_FALSE(near.projection(Vector3::Zero(), recent));
        for (int repetition = 0; repetition < 100; ++repetition) {
            Vector3 above = 0.2 * scale * random_point(random);
            above.z() = 0.03 * scale;
            REQUIRE(near.closest(above, recent));
            for (int i = 0; i < 20; ++i, ++queries) {
                const Vector3 p = recent.at + 0.03 * scale * random_point(random);
                const auto weights = near.projection(p, recent);
                if (!weights) continue;
                ++found;
                const NearTriangles::Hit best = brute_force(all, p);
                const Vector3 at = (*weights)[0] * best.entry->a + (*weights)[1] * best.entry->b +
                                   (*weights)[2] * best.entry->c;
                CHECK((at - best.at.point).norm() < 1e-10 * scale);
            }
        }
    }
    CHECK(found > queries / 20);
    CHECK(found < queries);
}

TEST_CASE("near triangles: of several at the same distance, the smallest number wins") {
    const Vector3 a(0, 0, 0), b(1, 0, 0), c(0, 1, 0), d(1, 1, 0);
    NearTriangles near;
    near.reset({0.5, 0.5, 0}, 2, {{a, b, c, 9}, {b, d, c, 4}, {c, a, b, 6}});
    CHECK(near.closest({0.25, 0.25, 0.25})->entry->face == 6);
    CHECK(near.closest({0.5, 0.5, 0.25})->entry->face == 4);
    CHECK(near.closest({0.75, 0.75, -0.25})->entry->face == 4);
    CHECK(near.contains(9));
    CHECK_FALSE(near.contains(5));
}

TEST_CASE("near triangles: nothing is found where a triangle outside the list may be closer") {
    NearTriangles near;
    const std::vector<NearTriangles::Entry> one = {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 3}};
    near.reset({0, 0, 0}, 1, one);
    CHECK(near.closest({0.1, 0.1, 0.4}));
    CHECK_FALSE(near.closest({0.1, 0.1, 0.6}));  // 0.62 from the centre and 0.6 from the triangle
    CHECK_FALSE(near.closest({0.9, 0.9, 0}));
    CHECK_FALSE(near.closest({1e200, 0, 0}));
    near.clear();
    CHECK_FALSE(near.closest({0.1, 0.1, 0.4}));
}

TEST_CASE("near triangles: a list that cannot be searched stays empty") {
    const std::vector<NearTriangles::Entry> one = {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 3}};
    NearTriangles near;
    for (const double reach : {0.0, -1.0, 1e-310, 1.7e308, HUGE_VAL, std::nan("")}) {
        near.reset({0, 0, 0}, reach, one);
        CHECK(near.empty());
    }
    near.reset({1e15, 0, 0}, 1, one);  // the rounding of coordinates is as large as the ball
    CHECK(near.empty());
    near.reset({0, 0, 0}, 1, std::vector(NearTriangles::max_size + 1, one.front()));
    CHECK(near.empty());
    near.reset({0, 0, 0}, 1, std::vector(NearTriangles::max_size, one.front()));
    CHECK_FALSE(near.empty());
}

TEST_CASE("near triangles: a narrowed list gives the same results") {
    Random random(7);
    std::size_t found = 0, queries = 0, sizes = 0;
    for (int repetition = 0; repetition < 100; ++repetition) {
        const auto all = soup(random, 60, {0, 0, 0}, 1);
        const Vector3 centre = random_point(random);
        const double reach = std::sqrt(brute_force(all, centre).at.distance_squared) + 0.4;
        NearTriangles large, small;
        large.reset(centre, reach, within(all, centre, reach));
        const Vector3 inner = centre + 0.1 * random_point(random);
        large.narrow(inner, 0.05, small);
        REQUIRE_FALSE(small.empty());
        CHECK(small.size() <= large.size());
        sizes += large.size() - small.size();
        for (int i = 0; i < 20; ++i, ++queries) {
            const Vector3 p = inner + 0.05 * random_point(random);
            const auto hit = small.closest(p);
            if (!hit) continue;
            ++found;
            const NearTriangles::Hit best = brute_force(all, p);
            CHECK(hit->entry->face == best.entry->face);
            CHECK(hit->at.distance_squared == best.at.distance_squared);
        }
    }
    CHECK(sizes > 0);
    CHECK(found == queries);
}

TEST_CASE("near triangles: a list is narrowed only where it is complete") {
    NearTriangles large, small;
    large.reset({0, 0, 0}, 1, {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 3}});
    large.narrow({0.1, 0.1, 0.2}, 0.1, small);
    CHECK(small.size() == 1);
    // 0.24 from the centre and 0.2 from the triangle, so that the new list reaches 0.75.
    large.narrow({0.1, 0.1, 0.2}, 0.4, small);
    CHECK(small.closest({0.1, 0.1, 0.4}));        // 0.4 from the triangle
    CHECK_FALSE(small.closest({0.1, 0.1, 0.5}));  // 0.5 from it, and 0.3 from the middle of the new list
    large.narrow({0.1, 0.1, 0.2}, 1.2, small);
    CHECK(small.empty());
}
