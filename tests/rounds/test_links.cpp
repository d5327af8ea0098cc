#include "faqem/detail/rounds/links.hpp"

#include "support/catch.hpp"
#include "support/meshes.hpp"

using namespace faqem;
using namespace faqem::detail;

namespace {

// Number of vertices in closed components.
std::size_t closed_count(const TriangleMesh& mesh) {
    const std::size_t vertices = mesh.positions.size();
    const std::vector<std::uint8_t> closed =
        closed_vertices(mesh.triangles, link_corners(mesh.triangles, vertices, 2), vertices);
    REQUIRE(closed.size() == mesh.positions.size());
    return static_cast<std::size_t>(std::count(closed.begin(), closed.end(), 1));
}

// The links by comparing all corners with each other.
std::vector<Links> brute_force_links(const std::vector<Triangle>& faces) {
    std::vector<Links> links(faces.size());
    for (Index f = 0; f < faces.size(); ++f) {
        for (unsigned k = 0; k < 3; ++k) {
            const Index a = faces[f][(k + 1) % 3], b = faces[f][(k + 2) % 3];
            unsigned others = 0;
            for (Index g = 0; g < faces.size(); ++g) {
                for (unsigned m = 0; m < 3; ++m) {
                    const Index c = faces[g][(m + 1) % 3], d = faces[g][(m + 2) % 3];
                    if (g == f || !((a == d && b == c) || (a == c && b == d))) continue;
                    ++others;
                    links[f][k] = 4 * g + m;
                }
            }
            if (others != 1) links[f][k] = no_index;
        }
    }
    return links;
}

}  // namespace

TEST_CASE("links: closed, open and non-manifold edges, at vertices of small and of high valence") {
    // Hubs have more sides than are compared with each other.
    for (const TriangleMesh& mesh :
         {test::torus(9, 5), test::grid(6), test::soup(3, 30, 400), test::fan(100)})
        CHECK(link_corners(mesh.triangles, mesh.positions.size(), 2) == brute_force_links(mesh.triangles));
}

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
