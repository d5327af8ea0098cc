#include <limits>

#include "faqem/compare.hpp"
#include "faqem/error.hpp"
#include "support/catch.hpp"
#include "support/meshes.hpp"

using namespace faqem;

namespace {

const TriangleMesh large_cube = test::scaled(test::cube(), 2);

MeshInfo info_of(const std::vector<Vec3>& positions, const std::vector<Triangle>& triangles) {
    return info(MeshView{positions, triangles});
}

}  // namespace

TEST_CASE("info: a closed cube") {
    const MeshInfo cube = info(large_cube.view());
    CHECK(cube.faces == 12);
    CHECK(cube.vertices == 8);
    CHECK(cube.components == 1);
    CHECK(cube.boundary_edges == 0);
    CHECK(cube.nonmanifold_edges == 0);
    CHECK(cube.degenerate_faces == 0);
    CHECK(cube.euler == 2);
    CHECK(cube.area == Approx(24));
    CHECK(cube.diagonal == Approx(std::sqrt(12.0)));
    CHECK(cube.box_min == Vec3{0, 0, 0});
    CHECK(cube.box_max == Vec3{2, 2, 2});
}

TEST_CASE("info: vertices at equal positions are welded, unreferenced ones are ignored") {
    TriangleMesh apart = test::separated(large_cube);
    for (std::size_t v = 2; v < apart.positions.size(); v += 3)
        for (double& x : apart.positions[v]) x = x == 0 ? -0.0 : x;
    apart.positions.push_back({100, 100, 100});
    const MeshInfo soup = info(apart.view());
    CHECK(soup.vertices == 8);
    CHECK(soup.boundary_edges == 0);
    CHECK(soup.euler == 2);
    CHECK(soup.box_max == Vec3{2, 2, 2});
}

TEST_CASE("info: boundary edges, non-manifold edges, components and degenerate faces are counted") {
    // Three triangles on the edge 0-1, one separate triangle, two degenerate ones.
    const std::vector<Vec3> positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1},
                                         {5, 0, 0}, {6, 0, 0}, {5, 1, 0}, {1, 0, 0}};
    const MeshInfo mesh =
        info_of(positions, {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}, {5, 6, 7}, {0, 1, 8}, {2, 2, 3}});
    CHECK(mesh.faces == 4);
    CHECK(mesh.degenerate_faces == 2);
    CHECK(mesh.vertices == 8);
    CHECK(mesh.components == 2);
    CHECK(mesh.nonmanifold_edges == 1);
    CHECK(mesh.boundary_edges == 9);
    CHECK(mesh.euler == 8 - 10 + 4);
}

TEST_CASE("info: the number of components does not depend on the order of the faces") {
    // A strip whose faces are ordered so that each one connects two larger components.
    std::vector<Vec3> positions;
    for (int i = 0; i < 64; ++i) positions.push_back({double(i), double(i % 2), 0});
    std::vector<Triangle> triangles;
    for (Index step = 32; step > 0; step /= 2) {
        for (Index i = 0; i + 2 * step < 64; i += step) triangles.push_back({i + 2 * step, i + step, i});
    }
    CHECK(info_of(positions, triangles).components == 1);
    CHECK(info_of(positions, {{9, 5, 1}, {8, 4, 0}, {9, 7, 8}}).components == 1);
}

TEST_CASE("info: an empty mesh gives zeros") {
    const MeshInfo nothing = info_of({}, {});
    CHECK(nothing.faces == 0);
    CHECK(nothing.vertices == 0);
    CHECK(nothing.diagonal == 0);
    CHECK(info_of({{1, 1, 1}}, {{0, 0, 0}}).degenerate_faces == 1);
}

TEST_CASE("info: NaN positions are handled, indices out of range are errors") {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const MeshInfo mesh = info_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {nan, nan, 0}, {nan, nan, 0}},
                                  {{0, 1, 2}, {0, 3, 2}, {1, 4, 0}});
    CHECK(mesh.faces == 3);
    CHECK(mesh.vertices == 4);
    CHECK_THROWS_AS(info_of({{0, 0, 0}}, {{0, 0, 1}}), InputError);
}
