#include "faqem/detail/simplify/build_result.hpp"

#include <catch2/catch.hpp>

#include "support/meshes.hpp"

using namespace faqem;

TEST_CASE("vertices that take the area of a face go back, the others stay moved") {
    const TriangleMesh mesh = test::square(2, 2, 0);  // 3 x 3 vertices
    std::vector<Vec3> now = mesh.positions;
    now[0] = {-0.5, -0.5, 0};
    now[4] = {2, 2, 1e-15};  // onto vertex 8: of two faces nothing is left
    CHECK(detail::revert_degenerate_faces(mesh.positions, mesh.triangles, now));
    CHECK(now[4] == mesh.positions[4]);
    CHECK(now[0] == Vec3{-0.5, -0.5, 0});
}

TEST_CASE("a face that never had an area cannot be given one") {
    const std::vector<Vec3> before = {{0, 0, 0}, {1, 0, 0}, {3, 0, 0}};
    std::vector<Vec3> now = {{0, 0, 0}, {1, 0, 0}, {4, 0, 0}};
    CHECK_FALSE(detail::revert_degenerate_faces(before, std::vector<Triangle>{{0, 1, 2}}, now));
}
