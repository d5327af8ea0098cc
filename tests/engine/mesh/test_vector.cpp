#include "faqem/engine/mesh/vector.hpp"

#include <cmath>

#include "support/catch.hpp"

using namespace faqem;
using namespace faqem::engine;

TEST_CASE("an area vector has the direction of the normal and twice the area as its length") {
    // A right triangle with legs 2 and 3 in the plane x = 1: area 3.
    const Vector3 a(1, 0, 0), b(1, 2, 0), c(1, 0, 3);
    CHECK(area_vector(a, b, c) == Vector3(6, 0, 0));
    CHECK(area_vector(b, c, a) == Vector3(6, 0, 0));
    CHECK(area_vector(a, c, b) == Vector3(-6, 0, 0));
    CHECK(area_vector(a, a, b) == Vector3(0, 0, 0));
}

TEST_CASE("conversion of positions to Eigen and back is exact") {
    const Vec3 p = {0.1, -0.0, 5e-324};
    const Vec3 back = to_array(to_eigen(p));
    CHECK(back == p);
    CHECK(std::signbit(back[1]));
}
