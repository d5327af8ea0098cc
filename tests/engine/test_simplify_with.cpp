#include "faqem/engine/metric/accumulated.hpp"
#include "faqem/engine/simplify_with.hpp"

#include <limits>

#include "support/catch.hpp"
#include "support/meshes.hpp"

using namespace faqem;
using namespace faqem::engine;
using namespace faqem::test;

TEST_CASE("simplify_with: vertices at one position are welded and faces with two equal corners are dropped") {
    // A square of two faces without shared vertices, and a face with two vertices at one position.
    const TriangleMesh split = make({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 0, 0}, {1, 1, 0}, {0, 1, 0}},
                                    {{0, 1, 2}, {3, 4, 5}, {0, 3, 1}});
    const CustomResult out = simplify_with(split.view(), AccumulatedMetric({}), {.target_faces = 2});
    CHECK(out.mesh.positions.size() == 4);
    CHECK(out.mesh.triangles.size() == 2);
    CHECK(out.face_origin == std::vector<Index>{0, 1});
    CHECK(out.vertex_origin == std::vector<Index>{0, 1, 2, 5});
    CHECK(out.loop.collapses == 0);
}

TEST_CASE("simplify_with: locked vertices do not move, even if only one of several at a position is locked") {
    TriangleMesh mesh = globe(12, 1);  // each pole consists of several vertices
    std::vector<std::uint8_t> locks(mesh.positions.size(), 0);
    locks[3] = 1;
    MeshView view = mesh.view();
    view.vertex_locks = locks;
    const CustomResult out = simplify_with(view, AccumulatedMetric({}), {.target_faces = 20});
    CHECK(out.mesh.triangles.size() <= 20);
    bool found = false;
    for (const Vec3& p : out.mesh.positions) found = found || p == mesh.positions[3];
    CHECK(found);
}

TEST_CASE("simplify_with: invalid input is an error that names the element") {
    TriangleMesh mesh = quad();
    mesh.triangles[1][2] = 4;
    CHECK_THROWS_WITH(simplify_with(mesh.view(), AccumulatedMetric({}), {}),
                      "face 1: vertex index out of range");
    mesh = quad();
    mesh.positions[2][1] = std::numeric_limits<double>::quiet_NaN();
    CHECK_THROWS_WITH(simplify_with(mesh.view(), AccumulatedMetric({}), {}),
                      "vertex 2: position is not finite");
    mesh = quad();
    MeshView view = mesh.view();
    const std::vector<std::uint8_t> few(3, 0);
    view.vertex_locks = few;
    CHECK_THROWS_AS(simplify_with(view, AccumulatedMetric({}), {}), InputError);
}
