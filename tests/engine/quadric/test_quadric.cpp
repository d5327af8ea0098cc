#include "faqem/engine/quadric/quadric.hpp"

#include <Eigen/LU>
#include <limits>

#include "support/catch.hpp"
#include "support/meshes.hpp"

using namespace faqem;
using namespace faqem::engine;

namespace {

Vector3 point(test::Random& random) {
    return {random.between(-2, 2), random.between(-2, 2), random.between(-2, 2)};
}

// The quadric diag(1, 1, e), whose minimum is the origin.
Quadric flat(double e) {
    Quadric q;
    q.xx = q.yy = 1;
    q.zz = e;
    return q;
}

}  // namespace

TEST_CASE("a plane quadric is w (n.p + d)^2 for normals of any length") {
    const Quadric q = Quadric::plane({1, 2, -2}, 3, 0.5);
    CHECK(q({0, 0, 0}) == 0.5 * 9);
    CHECK(q({1, 1, 1}) == 0.5 * 16);
    CHECK(q({1, -1, 1}) == 0);
}

TEST_CASE("a plane quadric through a point is the weighted squared distance to the plane") {
    const Vector3 n = Vector3(1, 2, 2) / 3, at(4, -5, 6);
    const Quadric q = Quadric::plane_through(n, at, 7);
    CHECK(q(at) == Approx(0).margin(1e-12));
    CHECK(q(at + Vector3(2, -1, 0)) == Approx(0).margin(1e-12));
    CHECK(q(at + 3 * n) == Approx(7 * 9));
}

TEST_CASE("an edge quadric is twice the squared area of the triangle with p") {
    // Paper eq. 11: half of |e x p + t|^2. Base 2, height 3: area 3.
    const Quadric q = Quadric::edge_area({0, 0, 1}, {2, 0, 1}, 1);
    CHECK(q({0, 3, 1}) == 18);
    CHECK(q({-5, 0, 4}) == 18);
    CHECK(q({77, 0, 1}) == 0);
    CHECK(Quadric::edge_area({2, 0, 1}, {0, 0, 1}, 1)({0, 3, 1}) == 18);
    CHECK(Quadric::edge_area({0, 0, 1}, {2, 0, 1}, 100)({0, 3, 1}) == 1800);
}

TEST_CASE("an edge quadric equals the matrix printed in the paper") {
    // 1/2 [E^T E, E^T t; t^T E, t^T t] with E = [e]_x
    test::Random random(1);
    for (int i = 0; i < 20; ++i) {
        const Vector3 a = point(random), b = point(random), p = point(random);
        const Vector3 e = b - a, t = a.cross(b);
        Eigen::Matrix3d cross;
        cross << 0, -e.z(), e.y(), e.z(), 0, -e.x(), -e.y(), e.x(), 0;
        Eigen::Matrix4d q;
        q.topLeftCorner<3, 3>() = cross.transpose() * cross;
        q.topRightCorner<3, 1>() = cross.transpose() * t;
        q.bottomLeftCorner<1, 3>() = t.transpose() * cross;
        q(3, 3) = t.squaredNorm();
        const Eigen::Vector4d h = p.homogeneous();
        CHECK(Quadric::edge_area(a, b, 1)(p) == Approx(0.5 * h.dot(q * h)).margin(1e-12));
    }
}

TEST_CASE("quadrics can be added and scaled") {
    test::Random random(2);
    const Quadric a = Quadric::plane(point(random), 0.3, 2);
    const Quadric b = Quadric::edge_area(point(random), point(random), 3);
    const Vector3 p = point(random);
    Quadric sum = a;
    sum += b;
    CHECK(sum(p) == Approx(a(p) + b(p)));
    CHECK((a + b)(p) == sum(p));
    sum *= 4;
    CHECK(sum(p) == Approx(4 * (a(p) + b(p))));
    CHECK(Quadric()(p) == 0);
}

TEST_CASE("the minimum of three plane quadrics is the intersection of the planes") {
    Quadric q = Quadric::plane_through({1, 0, 0}, {1, 2, 3}, 1);
    q += Quadric::plane_through({0, 1, 0}, {1, 2, 3}, 2);
    q += Quadric::plane_through({0, 0, 1}, {1, 2, 3}, 4);
    REQUIRE(q.minimum());
    CHECK(*q.minimum() == Vector3(1, 2, 3));
    CHECK(q(*q.minimum()) == 0);
    CHECK(q({2, 3, 4}) == 7);
}

TEST_CASE("the minimum solves A p = -b") {
    test::Random random(3);
    for (int i = 0; i < 50; ++i) {
        Quadric q;
        Eigen::Matrix3d a = Eigen::Matrix3d::Zero();
        Vector3 b = Vector3::Zero();
        for (int k = 0; k < 4; ++k) {
            const Vector3 n = point(random);
            const double d = random.between(-1, 1);
            q += Quadric::plane(n, d, 1);
            a += n * n.transpose();
            b += d * n;
        }
        REQUIRE(q.minimum());
        const Vector3 solved = a.fullPivLu().solve(-b);
        CHECK((*q.minimum() - solved).norm() <= 1e-6 * (1 + solved.norm()));
    }
}

TEST_CASE("a singular, indefinite or NaN quadric has no minimum") {
    Quadric q;
    CHECK_FALSE(q.minimum());
    q += Quadric::plane_through({1, 0, 0}, {1, 2, 3}, 1);
    CHECK_FALSE(q.minimum());
    q += Quadric::plane_through({0, 1, 0}, {1, 2, 3}, 1);
    CHECK_FALSE(q.minimum());
    const double nan = std::numeric_limits<double>::quiet_NaN();
    CHECK_FALSE(Quadric::plane({nan, 1, 1}, 1, 1).minimum());
    CHECK_FALSE(flat(-1).minimum());
}

TEST_CASE("the test for nearly singular quadrics is scale-invariant") {
    // det = e and (trace)^3 = (2 + e)^3: the limit 1e-9 (trace)^3 is near e = 8e-9.
    for (const double scale : {1.0, 0x1p60, 0x1p-60}) {
        Quadric good = flat(8.1e-9), bad = flat(7.9e-9);
        good *= scale;
        bad *= scale;
        CHECK(good.minimum());
        CHECK_FALSE(bad.minimum());
    }
}
