#include "faqem/engine/constraints/planar_borders.hpp"

#include <functional>

#include "faqem/engine/mesh/boundary_edges.hpp"
#include "support/catch.hpp"
#include "support/meshes.hpp"

using namespace faqem;
using namespace faqem::engine;

namespace {

PlanarBorders borders_of(const TriangleMesh& mesh) {
    const std::vector<Vector3> positions = test::vectors(mesh);
    return PlanarBorderSearch(positions, mesh.triangles)
        .find(find_boundary_edges(mesh.triangles, positions.size()));
}

TriangleMesh moved(TriangleMesh mesh, const std::function<Vec3(const Vec3&)>& to) {
    for (Vec3& p : mesh.positions) p = to(p);
    return mesh;
}

// A height that has no planes.
double rough(double x, double y) { return 0.3 * std::sin(3 * x * x + 5 * y) + 0.2 * std::cos(7 * x + y * y); }

Index count_of(const PlanarBorders& borders, Index at) {
    return static_cast<Index>(std::count(borders.at.begin(), borders.at.end(), at));
}

}  // namespace

TEST_CASE("the sides of a rough tile are four planes that meet in its corners") {
    const double angle = GENERATE(0.0, 0.4);
    const auto turned = [&](const Vec3& p) {
        const double c = std::cos(angle), s = std::sin(angle);
        return Vec3{c * p[0] - s * p[1], s * p[0] + c * p[1], rough(p[0], p[1])};
    };
    const TriangleMesh mesh = moved(test::grid(16), turned);
    const PlanarBorders borders = borders_of(mesh);
    CHECK(borders.flats.size() == 4);
    CHECK(count_of(borders, PlanarBorders::corner) == 4);
    for (const Index v : {0, 16, 272, 288}) CHECK(borders.at[v] == PlanarBorders::corner);
    CHECK(count_of(borders, no_index) == 15 * 15);
    for (Index v = 1; v < 16; ++v) {
        CHECK(borders.at[v] == borders.at[1]);
        CHECK(borders.at[17 * v] == borders.at[17]);
    }
    const Vector3 normal(-std::sin(angle), std::cos(angle), 0);  // of the side through vertices 0 and 16
    CHECK((borders.flats[borders.at[1]].along * normal).norm() < 1e-12);
    CHECK((borders.flats[borders.at[1]].along * Vector3(0, 0, 1) - Vector3(0, 0, 1)).norm() < 1e-12);
}

TEST_CASE("a side that is partly straight is a plane, and its straight part a line") {
    // The half x <= 16 of the side y = 0 has the height 0, but the surface beside it has not.
    const TriangleMesh mesh = moved(test::grid(32), [](const Vec3& p) {
        return Vec3{p[0], p[1], p[1] == 0 && p[0] <= 16 ? 0 : 1 + rough(p[0], p[1])};
    });
    const PlanarBorders borders = borders_of(mesh);
    CHECK(borders.flats.size() == 5);
    CHECK(count_of(borders, PlanarBorders::corner) == 5);
    CHECK(borders.at[16] == PlanarBorders::corner);
    const Eigen::Matrix3d& line = borders.flats[borders.at[3]].along;
    CHECK((line * Vector3(1, 1, 1) - Vector3(1, 0, 0)).norm() < 1e-12);
    const Eigen::Matrix3d& plane = borders.flats[borders.at[20]].along;
    CHECK((plane * Vector3(1, 1, 1) - Vector3(1, 0, 1)).norm() < 1e-12);
}

TEST_CASE("the rims of an open tube are planes without corners") {
    const PlanarBorders borders = borders_of(test::cylinder(16, 3, 2));
    CHECK(borders.flats.size() == 2);
    CHECK(count_of(borders, no_index) == 2 * 16);
    CHECK(count_of(borders, PlanarBorders::corner) == 0);
}

TEST_CASE("a flat surface needs no planes for its border") {
    CHECK(borders_of(test::grid(6)).at.empty());
    CHECK(borders_of(test::fan(16)).at.empty());
}

TEST_CASE("parts of fewer than 16 edges, as of small modelled pieces, have no planes") {
    const auto piece = [](const Vec3& p) { return Vec3{p[0], p[1], rough(p[0], p[1])}; };
    CHECK(borders_of(moved(test::grid(15), piece)).at.empty());
    CHECK(borders_of(moved(test::grid(16), piece)).flats.size() == 4);
}

TEST_CASE("closed surfaces and ragged borders have no planes") {
    CHECK(borders_of(test::cube()).at.empty());
    const TriangleMesh ragged = moved(test::grid(9), [](const Vec3& p) {
        return Vec3{p[0] + 0.3 * rough(p[1], p[0]), p[1] + 0.3 * rough(p[0] + 2, p[1]), rough(p[0], p[1])};
    });
    CHECK(borders_of(ragged).at.empty());
}

TEST_CASE("a merged vertex has the plane of either, or is a corner of both") {
    CHECK(PlanarBorders::merged(no_index, 2) == 2);
    CHECK(PlanarBorders::merged(2, 2) == 2);
    CHECK(PlanarBorders::merged(2, 3) == PlanarBorders::corner);
    CHECK(PlanarBorders::merged(PlanarBorders::corner, 3) == PlanarBorders::corner);
}
