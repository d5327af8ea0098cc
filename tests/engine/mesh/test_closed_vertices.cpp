#include "faqem/engine/mesh/closed_vertices.hpp"

#include "support/catch.hpp"
#include "support/meshes.hpp"

using namespace faqem;
using faqem::engine::closed_vertices;

namespace {

// Number of vertices in closed components.
std::size_t closed_count(const TriangleMesh& mesh) {
    const std::vector<std::uint8_t> closed = closed_vertices(mesh.triangles, mesh.positions.size());
    REQUIRE(closed.size() == mesh.positions.size());
    return static_cast<std::size_t>(std::count(closed.begin(), closed.end(), 1));
}

}  // namespace

TEST_CASE("closed vertices: each component is closed or not for itself") {
    const TriangleMesh cube = test::cube(), sheet = test::grid(4);
    CHECK(closed_count(cube) == 8);
    CHECK(closed_count(sheet) == 0);
    CHECK(closed_count(test::both(sheet, cube)) == 8);
    CHECK(closed_count(test::both(cube, test::both(sheet, test::torus(9, 5)))) == 8 + 45);
}

TEST_CASE(
    "closed vertices: edges with one or four faces, or with two of the same direction, are not closed") {
    TriangleMesh open = test::cube(), turned = test::cube(), touching = test::cube();
    open.triangles.pop_back();
    std::swap(turned.triangles[3][0], turned.triangles[3][1]);
    // A tetrahedron on the edge from 0 to 1.
    touching.positions.insert(touching.positions.end(), {{0, -1, -1}, {1, -2, -1}});
    touching.triangles.insert(touching.triangles.end(), {{0, 1, 8}, {1, 0, 9}, {0, 8, 9}, {1, 9, 8}});
    for (const TriangleMesh& mesh : {open, turned, touching}) CHECK(closed_count(mesh) == 0);
}

TEST_CASE("closed vertices: two closed surfaces that share a vertex are closed") {
    TriangleMesh mesh = test::cube();
    mesh.positions.insert(mesh.positions.end(), {{-1, 0, 0}, {0, -1, 0}, {0, 0, -1}});
    mesh.triangles.insert(mesh.triangles.end(), {{0, 8, 9}, {0, 9, 10}, {0, 10, 8}, {8, 10, 9}});
    CHECK(closed_count(mesh) == 11);
}
