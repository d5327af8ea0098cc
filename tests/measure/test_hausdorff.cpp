#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "faqem/compare.hpp"
#include "faqem/detail/measure/hausdorff.hpp"
#include "faqem/error.hpp"
#include "support/brute_force.hpp"
#include "support/meshes.hpp"

using namespace faqem;
using test::square;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// An egg: a sphere of rings x 2 rings quads, stretched and bent so that no two places are alike.
TriangleMesh egg(Index rings) {
    TriangleMesh mesh = test::globe(rings, 1);
    for (auto& [x, y, z] : mesh.positions) {
        const Vec3 bent = {x + 0.2 * z * z, 1.3 * y + 0.1 * x * x, 1.7 * z - 0.3 * y};
        x = bent[0], y = bent[1], z = bent[2];
    }
    return mesh;
}

bool same(const DistanceBound& a, const DistanceBound& b) {
    return a.value == b.value && a.bound == b.bound && a.pieces == b.pieces;
}

}  // namespace

TEST_CASE("a distance is found inside faces where all vertices coincide") {
    // A skew square by its one diagonal and by its other: farthest in the middle, from the plane
    // z = h (x + y).
    for (const double h : {1e-3, 0.1, 1.0}) {
        TriangleMesh a, b;
        a.positions = b.positions = {{0, 0, 0}, {1, 0, h}, {1, 1, 0}, {0, 1, h}};
        a.triangles = {{0, 1, 2}, {0, 2, 3}};
        b.triangles = {{0, 1, 3}, {1, 2, 3}};
        const double exact = h / std::sqrt(1 + 2 * h * h);
        const DistanceBound d = hausdorff(a.view(), b.view());
        CHECK(d.value <= exact * (1 + 1e-12));
        CHECK(d.bound >= exact * (1 - 1e-12));
        CHECK(d.bound <= d.value * 1.01 + 1e-8);

        const Comparison c = compare(a.view(), b.view(), {.samples = 10});
        for (const OneSided& side : {c.a_to_b, c.b_to_a}) {
            CHECK(side.max <= exact * (1 + 1e-12));
            CHECK(side.max_bound >= exact * (1 - 1e-12));
            CHECK(side.max_bound <= side.max * 1.01 + 1e-8);
        }
        CHECK(c.hausdorff_bound == std::max(c.a_to_b.max_bound, c.b_to_a.max_bound));
    }
}

TEST_CASE("a ridge far inside a big face is found from the flat side") {
    // The plane's two faces reach far beyond a tent with its ridge at height 1 over a base of width 4: from
    // the point under the ridge to a slope it is 2 / sqrt(5), but the plane's own rim is farther. With the
    // tent on a floor as wide as the plane only the ridge is left.
    TriangleMesh plane, tent;
    plane.positions = {{-10, -10, 0}, {10, -10, 0}, {10, 10, 0}, {-10, 10, 0}};
    plane.triangles = {{0, 1, 2}, {0, 2, 3}};
    tent.positions = {{-10, -10, 0}, {-2, -10, 0}, {0, -10, 1}, {2, -10, 0}, {10, -10, 0},
                      {-10, 10, 0},  {-2, 10, 0},  {0, 10, 1},  {2, 10, 0},  {10, 10, 0}};
    for (Index i = 0; i < 4; ++i) {
        tent.triangles.push_back({i, i + 1, i + 6});
        tent.triangles.push_back({i, i + 6, i + 5});
    }
    const Comparison c = compare(plane.view(), tent.view(), {.samples = 1, .tolerance = 1e-3});
    // Next to the ridge's foot the slopes are nearest, at x = 2 - s: s / sqrt(5).
    const double exact = 2 / std::sqrt(5.0);
    CHECK(c.a_to_b.max <= exact * (1 + 1e-12));
    CHECK(c.a_to_b.max_bound >= exact * (1 - 1e-12));
    CHECK(c.a_to_b.max_bound <= c.a_to_b.max * 1.001 + 1e-7);
    CHECK(c.b_to_a.max == Approx(1));
    CHECK(c.b_to_a.max_bound == Approx(1).epsilon(1e-3));
}

TEST_CASE("offset squares have a bound as tight as asked for") {
    const TriangleMesh a = square(3, 2, 0), b = square(5, 2, 0.25);
    for (const double tolerance : {0.1, 0.01, 0.001}) {
        const DistanceBound d = hausdorff(a.view(), b.view(), {.tolerance = tolerance});
        CHECK(d.value == Approx(0.25).epsilon(1e-12));
        CHECK(d.bound >= d.value);
        CHECK(d.bound <= d.value * (1 + tolerance) + 1e-8);
    }
}

TEST_CASE("value and bound enclose what dense samples show") {
    const TriangleMesh fine = egg(13), coarse = egg(7);
    const double there = test::sampled_distance(fine, coarse, 6),
                 back = test::sampled_distance(coarse, fine, 12);
    const Comparison c = compare(fine.view(), coarse.view(), {.samples = 100});
    CHECK(c.a_to_b.max_bound >= there);
    CHECK(c.b_to_a.max_bound >= back);
    CHECK(c.a_to_b.max_bound <= c.a_to_b.max * 1.01 + 1e-8);
    CHECK(c.b_to_a.max_bound <= c.b_to_a.max * 1.01 + 1e-8);
    // The grids are fine enough to come within 3% of the maximum.
    CHECK(c.a_to_b.max <= there * 1.03);
    CHECK(c.b_to_a.max <= back * 1.03);
    const DistanceBound d = hausdorff(fine.view(), coarse.view());
    CHECK(d.bound >= std::max(there, back));
    CHECK(d.bound <= d.value * 1.01 + 1e-8);
}

TEST_CASE("identical meshes and other triangulations of them are at distance zero at once") {
    const TriangleMesh mesh = egg(20);
    TriangleMesh turned = mesh;
    std::reverse(turned.triangles.begin(), turned.triangles.end());
    const DistanceBound d = hausdorff(mesh.view(), turned.view());
    CHECK(d.value < 1e-14);
    CHECK(d.bound < 1e-8);
    CHECK(d.pieces == 0);
    const TriangleMesh few = square(2, 1, 0), many = square(16, 1, 0);
    const DistanceBound flat = hausdorff(few.view(), many.view());
    CHECK(flat.value < 1e-14);
    CHECK(flat.bound < 1e-8);
}

TEST_CASE("a bound does not depend on the number of threads") {
    const TriangleMesh a = egg(30), b = egg(17);
    const HausdorffOptions one{.tolerance = 0.002, .threads = 1};
    const DistanceBound expected = hausdorff(a.view(), b.view(), one);
    CHECK(expected.pieces > 0);
    for (const std::uint32_t threads : {2u, 3u, 8u}) {
        HausdorffOptions options = one;
        options.threads = threads;
        CHECK(same(hausdorff(a.view(), b.view(), options), expected));
    }
}

TEST_CASE("where the work is capped the bound is wider and still one") {
    const TriangleMesh a = egg(30), b = egg(17);
    const DistanceBound full = hausdorff(a.view(), b.view(), {.tolerance = 1e-3});
    DistanceBound last = hausdorff(a.view(), b.view(), {.tolerance = 1e-3, .max_pieces = 0});
    CHECK(last.pieces == 0);
    CHECK(last.bound > last.value * 1.01);
    CHECK(last.bound >= full.value);
    for (const std::uint64_t cap : {std::uint64_t{1000}, std::uint64_t{10000}}) {
        const DistanceBound d = hausdorff(a.view(), b.view(), {.tolerance = 1e-3, .max_pieces = cap});
        CHECK(d.bound >= full.value);
        CHECK(d.bound <= last.bound);
        CHECK(d.value <= full.bound);
        CHECK(d.value >= last.value);
        last = d;
    }
    const DistanceBound none = hausdorff(a.view(), b.view(), {.tolerance = infinity});
    CHECK(none.pieces == 0);
    CHECK(none.bound >= full.value);
    CHECK(none.bound < infinity);
    const Comparison c = compare(a.view(), b.view(), {.samples = 100, .tolerance = infinity});
    CHECK(c.hausdorff <= full.bound);
    CHECK(c.hausdorff_bound >= full.value);
    CHECK(c.hausdorff_bound < infinity);
}

TEST_CASE("meshes are within a distance or they are not") {
    const TriangleMesh a = egg(30), b = egg(17);
    const DistanceBound d = hausdorff(a.view(), b.view(), {.tolerance = 1e-3});
    CHECK(within(a.view(), b.view(), d.bound * 1.001) == Within::yes);
    CHECK(within(a.view(), b.view(), d.bound * 5, 2) == Within::yes);
    CHECK(within(a.view(), b.view(), d.value * 0.999) == Within::no);
    CHECK(within(b.view(), a.view(), d.value * 0.3) == Within::no);
    CHECK(within(a.view(), b.view(), -1) == Within::no);
    CHECK(within(a.view(), b.view(), std::nan("")) == Within::undecided);

    const DistanceBound stopped = hausdorff(a.view(), b.view(), {.stop_above = d.value / 2});
    CHECK(stopped.value > d.value / 2);
    CHECK(stopped.bound >= stopped.value);
    const DistanceBound content = hausdorff(a.view(), b.view(), {.tolerance = 0, .stop_below = d.bound * 2});
    CHECK(content.bound <= d.bound * 2);
    CHECK(content.bound >= d.value);
    CHECK(content.pieces < d.pieces);
}

TEST_CASE("a tolerance that is no number is refused, faces far apart are not") {
    const TriangleMesh a = square(1, 1, 0);
    CHECK_THROWS_AS(hausdorff(a.view(), a.view(), {.tolerance = -1}), OptionError);
    CHECK_THROWS_AS(hausdorff(a.view(), a.view(), {.tolerance = std::nan("")}), OptionError);
    CHECK_THROWS_AS(compare(a.view(), a.view(), {.tolerance = -0.1}), OptionError);
    CHECK_THROWS_AS(hausdorff(a.view(), MeshView{}), InputError);
    CHECK(hausdorff(a.view(), square(1, 1, 1e200).view()).bound == infinity);
}
