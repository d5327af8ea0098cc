#include <cmath>
#include <limits>

#include "faqem/compare.hpp"
#include "faqem/error.hpp"
#include "support/catch.hpp"
#include "support/meshes.hpp"

using namespace faqem;
using test::globe;
using test::square;

namespace {

bool same(const OneSided& a, const OneSided& b) {
    return a.max == b.max && a.max_bound == b.max_bound && a.mean == b.mean &&
           a.mean_squared == b.mean_squared && a.mean_normal_degrees == b.mean_normal_degrees;
}

}  // namespace

TEST_CASE("compare: a mesh has distance zero to itself") {
    const TriangleMesh mesh = globe(20, 3);
    const Comparison c = compare(mesh.view(), mesh.view(), {.samples = 5000});
    CHECK(c.hausdorff < 1e-14);
    CHECK(c.chamfer < 1e-28);
    CHECK(c.mean_normal_degrees < 1e-5);
    CHECK(c.diagonal == Approx(6 * std::sqrt(3.0)).epsilon(0.01));
}

TEST_CASE("compare: distances of two parallel squares are exact") {
    const TriangleMesh a = square(3, 2, 0), b = square(5, 2, 0.25);
    const Comparison c = compare(a.view(), b.view(), {.samples = 3000});
    CHECK(c.hausdorff == Approx(0.25));
    CHECK(c.a_to_b.mean == Approx(0.25));
    CHECK(c.b_to_a.mean_squared == Approx(0.0625));
    CHECK(c.chamfer == Approx(0.125));
    CHECK(c.mean_normal_degrees == Approx(0).margin(1e-5));
    CHECK(c.diagonal == Approx(std::sqrt(8.0)));
}

TEST_CASE("compare: one-sided distances differ if one mesh extends beyond the other") {
    // The large square extends 1 beyond the small one on two sides: its far corner is sqrt(2) away, and the
    // mean over its area of the distance to [0, 1]^2 is (2 * 1/2 + integral of r over the unit square) / 4.
    const TriangleMesh small = square(2, 1, 0), big = square(64, 2, 0);
    const Comparison c = compare(small.view(), big.view(), {.samples = 40000});
    CHECK(c.a_to_b.max < 1e-15);
    CHECK(c.b_to_a.max == Approx(std::sqrt(2.0)));
    CHECK(c.hausdorff == c.b_to_a.max);
    const double r = (std::sqrt(2.0) + std::log(1 + std::sqrt(2.0))) / 3;
    CHECK(c.b_to_a.mean == Approx((1 + r) / 4).epsilon(1e-3));
    CHECK(c.b_to_a.mean_squared == Approx((2.0 / 3 + 2.0 / 3) / 4).epsilon(1e-3));
}

TEST_CASE("compare: the maximum distance is found at a vertex without samples nearby") {
    TriangleMesh flat = square(1, 1, 0), spike = flat;
    // A needle of length 3 with a very small area.
    spike.positions.insert(spike.positions.end(), {{0.5, 0.5, 0}, {0.5 + 1e-9, 0.5, 0}, {0.5, 0.5, 3}});
    spike.triangles.push_back({4, 5, 6});
    const Comparison c = compare(flat.view(), spike.view(), {.samples = 100});
    CHECK(c.a_to_b.max < 1e-8);
    CHECK(c.b_to_a.max == Approx(3));
}

TEST_CASE("compare: the normal deviation depends on the orientation") {
    const TriangleMesh a = square(4, 1, 0);
    TriangleMesh reversed = a;
    for (Triangle& t : reversed.triangles) std::swap(t[1], t[2]);
    CHECK(compare(a.view(), reversed.view(), {.samples = 500}).mean_normal_degrees == Approx(180));

    // The square, inclined by 30 degrees.
    TriangleMesh slope = a;
    for (Vec3& p : slope.positions) p[2] = std::tan(test::pi / 6) * p[0];
    CHECK(compare(a.view(), slope.view(), {.samples = 500}).mean_normal_degrees == Approx(30).epsilon(1e-6));
}

TEST_CASE("compare: the normal deviation is the smallest one among equally close faces") {
    // All points of the small square are closest to the ridge (x = 0) of a tent. The normals of the faces at
    // the ridge are inclined by 60 degrees to the left and to the right.
    const double s = std::sqrt(3.0);
    TriangleMesh tent;
    tent.positions = {{0, -1, 0}, {0, 9, 0}, {1, -1, -s}, {1, 9, -s}, {-1, -1, -s}, {-1, 9, -s}};
    tent.triangles = {{0, 2, 1}, {1, 2, 3}, {0, 1, 4}, {1, 5, 4}};
    TriangleMesh above = square(1, 1e-3, 2);
    const Comparison plain = compare(tent.view(), above.view(), {.samples = 200});
    CHECK(plain.b_to_a.mean_normal_degrees == Approx(60).epsilon(1e-3));
    TriangleMesh leaning = above;
    for (Vec3& p : leaning.positions) p = {p[0], p[1], 2 - 0.1 * p[0]};
    // Inclined to the right by atan 0.1, it is closer in angle to the right-hand faces, whatever their index.
    const double lean = std::atan(0.1) * 180 / test::pi;
    CHECK(compare(tent.view(), leaning.view(), {.samples = 200}).b_to_a.mean_normal_degrees ==
          Approx(60 - lean).epsilon(1e-3));
    std::swap(tent.triangles[0], tent.triangles[2]);
    std::swap(tent.triangles[1], tent.triangles[3]);
    CHECK(compare(tent.view(), leaning.view(), {.samples = 200}).b_to_a.mean_normal_degrees ==
          Approx(60 - lean).epsilon(1e-3));
}

TEST_CASE("compare: the distance of concentric spheres is the difference of their radii") {
    const TriangleMesh a = globe(90, 1), b = globe(90, 1.1);
    const Comparison c = compare(a.view(), b.view(), {.samples = 20000});
    CHECK(c.hausdorff == Approx(0.1).epsilon(0.01));
    CHECK(c.a_to_b.mean == Approx(0.1).epsilon(0.01));
    CHECK(c.b_to_a.mean == Approx(0.1).epsilon(0.01));
}

TEST_CASE("compare: samples are uniform over the area") {
    // Half of the area is in two large faces at height 1, half in 20,000 small ones at height 0: both the
    // mean and the mean squared distance to the plane at height 0 are 1/2.
    TriangleMesh mesh = square(100, 1, 0);
    const auto first = static_cast<Index>(mesh.positions.size());
    mesh.positions.insert(mesh.positions.end(), {{0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}});
    mesh.triangles.push_back({first, first + 1, first + 2});
    mesh.triangles.push_back({first, first + 2, first + 3});
    const TriangleMesh plane = square(1, 1, 0);
    constexpr double no_search = std::numeric_limits<double>::infinity();
    const Comparison c = compare(mesh.view(), plane.view(), {.samples = 10000, .tolerance = no_search});
    CHECK(c.a_to_b.mean == Approx(0.5).epsilon(1e-3));
    CHECK(c.a_to_b.mean_squared == Approx(0.5).epsilon(1e-3));
}

TEST_CASE("compare: the result depends on the seed, but not on the number of threads") {
    const TriangleMesh a = globe(30, 1), b = globe(17, 1.05);
    const Comparison one = compare(a.view(), b.view(), {.samples = 20000, .threads = 1});
    for (const std::uint32_t threads : {2u, 3u, 8u}) {
        const Comparison many = compare(a.view(), b.view(), {.samples = 20000, .threads = threads});
        CHECK(same(one.a_to_b, many.a_to_b));
        CHECK(same(one.b_to_a, many.b_to_a));
    }
    const Comparison other = compare(a.view(), b.view(), {.samples = 20000, .seed = 2});
    CHECK(!same(one.a_to_b, other.a_to_b));
    CHECK(one.chamfer == Approx(other.chamfer).epsilon(0.02));
}

TEST_CASE("compare: the result is symmetric up to sampling, and scales with the meshes") {
    TriangleMesh a = globe(20, 1), b = globe(9, 1.02);
    const Comparison ab = compare(a.view(), b.view(), {.samples = 20000});
    const Comparison ba = compare(b.view(), a.view(), {.samples = 20000});
    CHECK(ab.hausdorff == Approx(ba.hausdorff).epsilon(0.01));
    CHECK(ab.chamfer == Approx(ba.chamfer).epsilon(0.03));
    for (TriangleMesh* mesh : {&a, &b}) {
        for (Vec3& p : mesh->positions) {
            for (double& x : p) x *= 1024;
        }
    }
    const Comparison scaled = compare(a.view(), b.view(), {.samples = 20000});
    CHECK(scaled.hausdorff == 1024 * ab.hausdorff);
    CHECK(scaled.chamfer == 1024 * 1024 * ab.chamfer);
}

TEST_CASE("compare: degenerate and non-finite faces are skipped, invalid indices are errors") {
    TriangleMesh mesh = square(1, 1, 0);
    mesh.positions.push_back({0, 0, std::numeric_limits<double>::quiet_NaN()});
    mesh.positions.push_back({0, 0, std::numeric_limits<double>::infinity()});
    mesh.positions.push_back({5, 5, 5});
    mesh.triangles.push_back({0, 1, 4});
    mesh.triangles.push_back({0, 1, 5});
    mesh.triangles.push_back({6, 6, 0});
    const TriangleMesh plain = square(1, 1, 0);
    CHECK(compare(mesh.view(), plain.view(), {.samples = 100}).hausdorff < 1e-15);

    TriangleMesh flat = plain;
    flat.triangles = {{0, 0, 1}};
    CHECK_THROWS_AS(compare(flat.view(), plain.view()), InputError);
    CHECK_THROWS_AS(compare(plain.view(), MeshView{}), InputError);
    flat.triangles = {{0, 1, 99}};
    CHECK_THROWS_AS(compare(plain.view(), flat.view()), InputError);
}
