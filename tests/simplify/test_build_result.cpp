#include "faqem/detail/simplify/build_result.hpp"

#include "support/catch.hpp"
#include "support/meshes.hpp"

using namespace faqem;

TEST_CASE("fitting is reverted for vertices of faces that become degenerate, and only for these") {
    const TriangleMesh mesh = test::square(2, 2, 0);  // 3 x 3 vertices
    std::vector<Vec3> now = mesh.positions;
    now[0] = {-0.5, -0.5, 0};
    now[4] = {2, 2, 1e-15};  // at vertex 8: two faces become degenerate
    CHECK(detail::revert_degenerate_faces(mesh.positions, mesh.triangles, now));
    CHECK(now[4] == mesh.positions[4]);
    CHECK(now[0] == Vec3{-0.5, -0.5, 0});
}

TEST_CASE("revert_degenerate_faces fails if a face was degenerate before fitting") {
    const std::vector<Vec3> before = {{0, 0, 0}, {1, 0, 0}, {3, 0, 0}};
    std::vector<Vec3> now = {{0, 0, 0}, {1, 0, 0}, {4, 0, 0}};
    CHECK_FALSE(detail::revert_degenerate_faces(before, std::vector<Triangle>{{0, 1, 2}}, now));
}
