#include <algorithm>
#include <cmath>

#include "faqem/compare.hpp"
#include "faqem/detail/measure/hausdorff.hpp"
#include "faqem/error.hpp"
#include "support/brute_force.hpp"
#include "support/catch.hpp"
#include "support/meshes.hpp"

using namespace faqem;
using test::square;

namespace {

/// A sphere of rings x 2 rings quads, stretched and bent so that it has no symmetries.
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

TEST_CASE("hausdorff: a maximum in the interior of faces is found if all vertices coincide") {
    // A skew quad, triangulated with either diagonal. The maximum distance is that of the middle to the plane
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

TEST_CASE("hausdorff: a maximum far inside a large face is found") {
    // A tent with its ridge at height 1 over a base of width 4, on a floor as large as the plane. The maximum
    // distance from the plane is that of the point below the ridge to a slope, 2 / sqrt(5).
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
    // The distance from the point x = 2 - s of the plane to the slope is s / sqrt(5), largest for s = 2.
    const double exact = 2 / std::sqrt(5.0);
    CHECK(c.a_to_b.max <= exact * (1 + 1e-12));
    CHECK(c.a_to_b.max_bound >= exact * (1 - 1e-12));
    CHECK(c.a_to_b.max_bound <= c.a_to_b.max * 1.001 + 1e-7);
    CHECK(c.b_to_a.max == Approx(1));
    CHECK(c.b_to_a.max_bound == Approx(1).epsilon(1e-3));
}

TEST_CASE("hausdorff: the bound of offset squares is within the tolerance") {
    const TriangleMesh a = square(3, 2, 0), b = square(5, 2, 0.25);
    for (const double tolerance : {0.1, 0.01, 0.001}) {
        const DistanceBound d = hausdorff(a.view(), b.view(), {.tolerance = tolerance});
        CHECK(d.value == Approx(0.25).epsilon(1e-12));
        CHECK(d.bound >= d.value);
        CHECK(d.bound <= d.value * (1 + tolerance) + 1e-8);
    }
}

TEST_CASE("hausdorff: value and bound agree with dense sampling") {
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

TEST_CASE("hausdorff: identical surfaces have distance zero, also if triangulated differently") {
    const TriangleMesh mesh = egg(20);
    TriangleMesh reordered = mesh;
    std::reverse(reordered.triangles.begin(), reordered.triangles.end());
    const DistanceBound d = hausdorff(mesh.view(), reordered.view());
    CHECK(d.value < 1e-14);
    CHECK(d.bound < 1e-8);
    CHECK(d.pieces == 0);
    const TriangleMesh few = square(2, 1, 0), many = square(16, 1, 0);
    const DistanceBound flat = hausdorff(few.view(), many.view());
    CHECK(flat.value < 1e-14);
    CHECK(flat.bound < 1e-8);
}

TEST_CASE("hausdorff: the result does not depend on the number of threads") {
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

TEST_CASE("hausdorff: with limited work, the bounds are wider but valid") {
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
    const DistanceBound none = hausdorff(a.view(), b.view(), {.tolerance = test::infinity});
    CHECK(none.pieces == 0);
    CHECK(none.bound >= full.value);
    CHECK(none.bound < test::infinity);
    const Comparison c = compare(a.view(), b.view(), {.samples = 100, .tolerance = test::infinity});
    CHECK(c.hausdorff <= full.bound);
    CHECK(c.hausdorff_bound >= full.value);
    CHECK(c.hausdorff_bound < test::infinity);
}

TEST_CASE("hausdorff: within() compares with a distance, and stop_above and stop_below end the search") {
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

TEST_CASE("hausdorff: invalid tolerances and empty meshes are errors, very distant meshes are not") {
    const TriangleMesh a = square(1, 1, 0);
    CHECK_THROWS_AS(hausdorff(a.view(), a.view(), {.tolerance = -1}), OptionError);
    CHECK_THROWS_AS(hausdorff(a.view(), a.view(), {.tolerance = std::nan("")}), OptionError);
    CHECK_THROWS_AS(compare(a.view(), a.view(), {.tolerance = -0.1}), OptionError);
    CHECK_THROWS_AS(hausdorff(a.view(), MeshView{}), InputError);
    CHECK(hausdorff(a.view(), square(1, 1, 1e200).view()).bound == test::infinity);
}
