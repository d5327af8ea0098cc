#include "faqem/engine/mesh/vector.hpp"

#include <catch2/catch.hpp>
#include <cmath>

using namespace faqem;
using namespace faqem::engine;

TEST_CASE("an area vector is twice the area, along the normal of the winding") {
    // Legs 2 and 3 in the plane x = 1: area 3.
    const Vector3 a(1, 0, 0), b(1, 2, 0), c(1, 0, 3);
    CHECK(area_vector(a, b, c) == Vector3(6, 0, 0));
    CHECK(area_vector(b, c, a) == Vector3(6, 0, 0));
    CHECK(area_vector(a, c, b) == Vector3(-6, 0, 0));
    CHECK(area_vector(a, a, b) == Vector3(0, 0, 0));
}

TEST_CASE("positions go into Eigen and back bit by bit") {
    const Vec3 p = {0.1, -0.0, 5e-324};
    const Vec3 back = to_array(to_eigen(p));
    CHECK(back == p);
    CHECK(std::signbit(back[1]));
}
