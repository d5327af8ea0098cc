#include "faqem/engine/quadric/terms.hpp"

#include "support/catch.hpp"
#include "support/meshes.hpp"

using namespace faqem;
using namespace faqem::engine;

namespace {

// Sum of the base terms of the faces at v.
Quadric base_at(const TriangleMesh& mesh, Index v, BaseWeight weight, double plane_area = 1) {
    const CollapseMesh collapse_mesh = test::collapse_mesh_of(mesh);
    Quadric q;
    collapse_mesh.for_each_face(v, [&](Index f, unsigned) {
        q += base_term(collapse_mesh.area_vector(f), collapse_mesh.position(v), weight, plane_area, 1e-12);
    });
    return q;
}

Quadric area_of_pair(const TriangleMesh& mesh, Index u, Index v,
                     const std::vector<std::pair<Index, Index>>& extra = {}) {
    const CollapseMesh collapse_mesh = test::collapse_mesh_of(mesh);
    return area_term(collapse_mesh, PairTable(collapse_mesh, extra), u, v);
}

// Twice the squared area of the triangle abp.
double twice_squared_area(const Vector3& a, const Vector3& b, const Vector3& p) {
    const double area = 0.5 * area_vector(a, b, p).norm();
    return 2 * area * area;
}

}  // namespace

TEST_CASE("the base terms at a cube corner have the corner as their minimum for every weight") {
    // Paper eq. 1 and 5. At vertex 0 each of the three planes has two faces of area 1/2:
    // K summed is 2 (x^2 + y^2 + z^2), weighted with A half of it, with 1 / (w A) double of it over w.
    const TriangleMesh cube = test::cube();
    const Vector3 p(1, 2, 3);
    CHECK(base_at(cube, 0, BaseWeight::unit)(p) == 2 * 14);
    CHECK(base_at(cube, 0, BaseWeight::area)(p) == 14);
    CHECK(base_at(cube, 0, BaseWeight::inverse_area)(p) == 4 * 14);
    CHECK(base_at(cube, 0, BaseWeight::inverse_area, 4)(p) == 14);
    // At vertex 1 the plane x = 1 has two faces, each other plane one.
    CHECK(base_at(cube, 1, BaseWeight::unit)({3, 5, 7}) == 2 * 4 + 25 + 49);
    for (const BaseWeight weight : {BaseWeight::unit, BaseWeight::area, BaseWeight::inverse_area}) {
        for (Index v = 0; v < 8; ++v) {
            const auto minimum = base_at(cube, v, weight).minimum();
            REQUIRE(minimum);
            CHECK(to_array(*minimum) == cube.positions[v]);
        }
    }
}

TEST_CASE("the base terms of a plane grid measure the squared height above it and have no minimum") {
    const Quadric q = base_at(test::grid(2), 4, BaseWeight::unit);
    CHECK(q({17, -4, 3}) == 6 * 9);
    CHECK_FALSE(q.minimum());
}

TEST_CASE("inverse area weights favour small faces, area weights large ones") {
    // A small face (area 1/2) in z = 0 and a large one (area 8) in x = 0.
    Quadric inverse = base_term({0, 0, 1}, Vector3::Zero(), BaseWeight::inverse_area, 1, 0);
    inverse += base_term({16, 0, 0}, Vector3::Zero(), BaseWeight::inverse_area, 1, 0);
    CHECK(inverse({1, 0, 0}) == 1 / 8.0);
    CHECK(inverse({0, 0, 1}) == 2);
    Quadric area = base_term({0, 0, 1}, Vector3::Zero(), BaseWeight::area, 1, 0);
    area += base_term({16, 0, 0}, Vector3::Zero(), BaseWeight::area, 1, 0);
    CHECK(area({1, 0, 0}) == 8);
    CHECK(area({0, 0, 1}) == 0.5);
}

TEST_CASE("areas are clamped from below and a face of zero area has no base term") {
    CHECK(base_term({0, 0, 2e-9}, Vector3::Zero(), BaseWeight::inverse_area, 1, 1e-3)({0, 0, 1}) ==
          Approx(1000));
    CHECK(base_term({0, 0, 0}, {1, 1, 1}, BaseWeight::inverse_area, 1, 1e-3)({5, 5, 5}) == 0);
    const double nan = std::numeric_limits<double>::quiet_NaN();
    CHECK(base_term({nan, 0, 0}, {1, 1, 1}, BaseWeight::unit, 1, 0)({5, 5, 5}) == 0);
}

TEST_CASE("boundary neighbours are found at vertices with two boundary edges, smaller index first") {
    const auto neighbours = [](const TriangleMesh& mesh, Index v) {
        const CollapseMesh collapse_mesh = test::collapse_mesh_of(mesh);
        return boundary_neighbours(PairTable(collapse_mesh, {}), v);
    };
    using Two = std::array<Index, 2>;
    CHECK_FALSE(neighbours(test::fan(6), 0));
    CHECK(neighbours(test::fan(6), 1) == Two{2, 6});
    CHECK(neighbours(test::fan(6), 6) == Two{1, 5});
    CHECK(neighbours(test::quad(), 2) == Two{1, 3});
    CHECK_FALSE(neighbours(test::cube(), 3));
    CHECK_FALSE(neighbours(test::bow_tie(), 0));  // four boundary edges
    CHECK_FALSE(neighbours(test::book(), 0));     // three boundary edges
    CHECK(neighbours(test::book(), 2) == Two{0, 1});
}

TEST_CASE("the curvature of a circular boundary is about 1/(4R)") {
    // Paper eq. 6 on a regular n-gon with step angle t: |d'| = 2R sin t and |d''| = 2R (1 - cos t) are
    // perpendicular, so that kappa = (1 - cos t) / (2R sin^2 t) = 1 / (2R (1 + cos t)).
    for (const int n : {3, 5, 6, 8, 100}) {
        for (const double radius : {0.5, 1.0, 20.0}) {
            const double t = 2 * test::pi / n;
            const auto at = [&](int i) {
                return Vector3(radius * std::cos(i * t), radius * std::sin(i * t), 3);
            };
            const double kappa = boundary_curvature(at(1), at(0), at(2));
            CHECK(kappa == Approx(1 / (2 * radius * (1 + std::cos(t)))));
            CHECK(boundary_curvature(at(1), at(2), at(0)) == Approx(kappa));
            if (n == 100) CHECK(kappa == Approx(1 / (4 * radius)).epsilon(0.01));
        }
    }
}

TEST_CASE("the curvature of a straight boundary, or of one that reverses its direction, is 0") {
    CHECK(boundary_curvature({1, 1, 1}, {0, 0, 0}, {3, 3, 3}) == 0);
    CHECK(boundary_curvature({1, 0, 0}, {0, 0, 0}, {0, 0, 0}) == 0);
    CHECK(boundary_term({1, 1, 1}, {0, 0, 0}, {3, 3, 3})({5, -7, 9}) == 0);
}

TEST_CASE("boundary planes are scaled by the curvature and their normals are not normalised") {
    // Paper eq. 6-9 at a right angle with legs s: |d'| = s sqrt 2, |d' x d''| = 2 s^2,
    // kappa = 1 / (s sqrt 2); n1 = (v1 - v2) x (v3 - v1) = (0, 0, -s^2), d = v1 - v2 = (-s, 0, 0).
    for (const double s : {1.0, 2.0, 10.0}) {
        const double kappa = 1 / (s * std::sqrt(2.0));
        const Quadric q = boundary_term({0, 0, 0}, {s, 0, 0}, {0, s, 0});
        CHECK(q({0, 0, 3}) == Approx(kappa * 9 * s * s * s * s));
        CHECK(q({3, 0, 0}) == Approx(kappa * 9 * s * s));
        CHECK(q({0, 3, 0}) == 0);
        // The second plane is perpendicular to v1 - v2, so that the order of the neighbours matters.
        CHECK(boundary_term({0, 0, 0}, {0, s, 0}, {s, 0, 0})({0, 3, 0}) == Approx(kappa * 9 * s * s));
        CHECK(boundary_term({0, 0, 0}, {0, s, 0}, {s, 0, 0})({3, 0, 0}) == 0);
    }
}

TEST_CASE("the boundary term on a circular arc agrees with its closed form") {
    // Radius R, step angle t: |d| = 2R sin(t/2) and |n1| = |d|^2 sin t; both planes pass through v1.
    const double radius = 2, t = test::pi / 8;
    const auto at = [&](int i) { return Vector3(radius * std::cos(i * t), radius * std::sin(i * t), 1); };
    const double kappa = 1 / (2 * radius * (1 + std::cos(t)));
    const double d = 2 * radius * std::sin(t / 2), n = d * d * std::sin(t);
    const Quadric q = boundary_term(at(4), at(3), at(5));
    CHECK(q(at(4)) == Approx(0).margin(1e-12));
    CHECK(q(at(4) + Vector3(0, 0, 0.5)) == Approx(kappa * n * n * 0.25));
    CHECK(q(at(3)) == Approx(kappa * d * d * d * d));
}

TEST_CASE("the normal term is the tangent plane with the area-weighted normal") {
    // Paper eq. 10. The normal at corner 0 of the cube is (-1 -1 -1) / sqrt 3. Corner 1 has one face each
    // in y and z, and two in x.
    const CollapseMesh cube = test::collapse_mesh_of(test::cube());
    CHECK(normal_term(cube, 0)({1, 2, 3}) == Approx(36 / 3.0));
    CHECK(normal_term(cube, 0)({1, -3, 2}) == Approx(0).margin(1e-12));
    CHECK(normal_term(cube, 1)({3, 1, 1}) == Approx(4 / 6.0));
    // Faces of area 1/2 (normal z) and 2 (normal y) have the weights 1 : 4.
    const CollapseMesh uneven = test::collapse_mesh_of(
        test::make({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-2, 0, 0}, {0, 0, 2}}, {{0, 1, 2}, {0, 3, 4}}));
    CHECK(normal_term(uneven, 0)({0, 0, 1}) == Approx(1 / 17.0));
    CHECK(normal_term(uneven, 0)({0, 1, 0}) == Approx(16 / 17.0));
}

TEST_CASE("the normal term is zero if the normals cancel") {
    const CollapseMesh sheet =
        test::collapse_mesh_of(test::make({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 1}}));
    CHECK(normal_term(sheet, 0)({5, 6, 7}) == 0);
}

TEST_CASE("the area term sums the boundary edges at both vertices and counts a shared edge once") {
    // Paper eq. 11 on the unit square, p = (1/2, -1, 2). Squared distances from p to the sides: 0-1: 1 + 4,
    // 0-3 and 1-2: 1/4 + 4, 2-3: 4 + 4; each side, of length 1, contributes half of that.
    const Vector3 p(0.5, -1, 2);
    CHECK(area_of_pair(test::quad(), 0, 1)(p) == Approx((5 + 4.25 + 4.25) / 2));
    CHECK(area_of_pair(test::quad(), 1, 0)(p) == Approx((5 + 4.25 + 4.25) / 2));
    CHECK(area_of_pair(test::quad(), 0, 2)(p) == Approx((5 + 4.25 + 4.25 + 8) / 2));
    CHECK(area_of_pair(test::quad(), 0, 1)({0, 0, 0}) == Approx(0.5));
}

TEST_CASE("the area term includes boundary edges only") {
    const Vector3 p(0.3, 0.4, 0.5);
    CHECK(area_of_pair(test::cube(), 0, 1)(p) == 0);
    // Pair of the centre of a disc and a boundary vertex: the two boundary edges at the latter.
    const TriangleMesh fan = test::fan(6);
    const auto at = [&](Index v) { return to_eigen(fan.positions[v]); };
    CHECK(area_of_pair(fan, 0, 1)(p) ==
          Approx(twice_squared_area(at(1), at(2), p) + twice_squared_area(at(1), at(6), p)));
    // The edge (0, 1) of the book has three faces; the virtual pair of the two quads has none.
    const TriangleMesh book = test::book();
    double six = 0;
    for (Index page = 2; page < 5; ++page) {
        for (Index end = 0; end < 2; ++end)
            six += twice_squared_area(to_eigen(book.positions[end]), to_eigen(book.positions[page]), p);
    }
    CHECK(area_of_pair(book, 0, 1)(p) == Approx(six));
    const TriangleMesh apart = test::both(test::quad(), test::moved(test::quad(), {3, 0, 0}));
    const auto of = [&](Index v) { return to_eigen(apart.positions[v]); };
    CHECK(area_of_pair(apart, 1, 4, {{1, 4}})(p) ==
          Approx(twice_squared_area(of(1), of(0), p) + twice_squared_area(of(1), of(2), p) +
                 twice_squared_area(of(4), of(5), p) + twice_squared_area(of(4), of(7), p)));
}
