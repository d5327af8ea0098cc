#include "asset/scene/rounding_weld.hpp"

#include <limits>

#include "support/catch.hpp"
#include "support/meshes.hpp"
#include "support/torn_meshes.hpp"

using namespace faqem;
using namespace faqem::detail;
using namespace faqem::test;

namespace {

constexpr double unit = std::numeric_limits<float>::epsilon();  // in the last place of 1

std::uint64_t boundary_edges_after(const TriangleMesh& mesh) {
    TriangleMesh welded = mesh;
    find_rounding_weld(mesh.positions, mesh.triangles).apply(welded.positions);
    return open_edges(welded);
}

/// Two sheets of 2 n^2 faces in the plane z = 0, from x = 0 to 1 and from there to 2, with a gap between them. The
/// coordinates are floats.
TriangleMesh two_sheets(Index n, double gap) {
    TriangleMesh left = square(n, 1, 0), right = square(n, 1, 0);
    for (Vec3& p : right.positions) p[0] += 1 + gap;
    TriangleMesh result = both(left, right);
    for (Vec3& p : result.positions)
        for (double& x : p) x = static_cast<float>(x);
    return result;
}

}  // namespace

TEST_CASE("a soup whose corners differ by rounding is closed again") {
    const TriangleMesh ball = icosphere(3);
    const double scale = GENERATE(1.0, 1e-6, 1e6, 1e-30, 1e30);
    const double offset =
        GENERATE(0.0, 1.0, 100.0);  // relative to the scale; 1: the ball touches the planes x, y, z = 0
    const TriangleMesh torn = float_soup(scaled(moved(ball, {offset, offset, offset}), scale), 1);
    CHECK(open_edges(torn) > 3000);
    const RoundingWeld found = find_rounding_weld(torn.positions, torn.triangles);
    CHECK(found.welded > 2000);
    CHECK(found.near_edges == 0);
    CHECK(boundary_edges_after(torn) == 0);
}

TEST_CASE("the edges of a soup may be few units of rounding long") {
    // A million units from the origin floats are 1/16 apart, and edges about 2 units long.
    const TriangleMesh torn = float_soup(moved(scaled(icosphere(2), 6), {1e6, 1e6, 1e6}), 1);
    CHECK(open_edges(torn) > 0);
    CHECK(boundary_edges_after(torn) == 0);
}

TEST_CASE("closed meshes and equal corners are left alone") {
    const TriangleMesh ball = icosphere(2);
    CHECK(find_rounding_weld(ball.positions, ball.triangles).representative.empty());
    const TriangleMesh cut = float_soup(ball, 0);
    CHECK(find_rounding_weld(cut.positions, cut.triangles).representative.empty());
    CHECK(find_rounding_weld({}, {}).representative.empty());
    // Two closed balls that touch within rounding stay two.
    const TriangleMesh two = both(ball, moved(ball, {2 + unit, 0, 0}));
    CHECK(find_rounding_weld(two.positions, two.triangles).representative.empty());
}

TEST_CASE("a gap of 100 units stays open and is counted") {
    const TriangleMesh sheets = two_sheets(5, 100 * unit);
    const RoundingWeld found = find_rounding_weld(sheets.positions, sheets.triangles);
    CHECK(found.welded == 0);
    CHECK(found.representative.empty());
    CHECK(found.near_edges == 10);
    const TriangleMesh apart = two_sheets(5, 1000 * unit);
    CHECK(find_rounding_weld(apart.positions, apart.triangles).near_edges == 0);
    const TriangleMesh torn = two_sheets(5, 2 * unit);
    CHECK(find_rounding_weld(torn.positions, torn.triangles).welded == 6);
    CHECK(find_rounding_weld(torn.positions, torn.triangles).near_edges == 0);
}

TEST_CASE("details near the origin of a large mesh keep gaps that are small in the mesh") {
    // The largest coordinate, 10^6, has a tolerance of more than 1.
    TriangleMesh sheets = two_sheets(5, 0.05);
    const auto first = static_cast<Index>(sheets.positions.size());
    for (const Vec3& p : {Vec3{1e6, 0, 0}, {1e6, 1e5, 0}, {1e6, 0, 1e5}}) sheets.positions.push_back(p);
    sheets.triangles.push_back({first, first + 1, first + 2});
    CHECK(find_rounding_weld(sheets.positions, sheets.triangles).welded == 0);
}

TEST_CASE("two corners of a face are not welded") {
    // A needle whose short edge is shorter than the tolerance, beside a face that shares its long edge.
    const double s = 3 * unit;
    const TriangleMesh needle =
        make({{1, 0, 0}, {1 + s, 0, 0}, {1, 1, 0}, {2, 0, 0}}, {{0, 1, 2}, {1, 3, 2}});
    CHECK(find_rounding_weld(needle.positions, needle.triangles).welded == 0);
    // A copy of the second face is welded to the nearer corner, corner by corner.
    const TriangleMesh cut =
        make({{1, 0, 0}, {1 + s, 0, 0}, {1, 1, 0}, {1 + s + unit, 0, 0}, {2, 0, 0}, {1 + unit, 1, 0}},
             {{0, 1, 2}, {3, 4, 5}});
    CHECK(find_rounding_weld(cut.positions, cut.triangles).representative ==
          std::vector<Index>{0, 1, 2, 1, 4, 2});
    // Nor by means of a third vertex that is near both.
    const TriangleMesh bridge = make(
        {{1, 0, 0}, {3, 3, 0}, {3, 0, 3}, {1 + s, 0, 0}, {1 - s, 0, 0}, {0, 0, 3}}, {{0, 1, 2}, {3, 4, 5}});
    const RoundingWeld found = find_rounding_weld(bridge.positions, bridge.triangles);
    REQUIRE(found.welded == 1);
    CHECK(found.representative[3] != found.representative[4]);
}

TEST_CASE("ties are broken by index") {
    // Vertex 6 has the same distance from vertices 0 and 3, which are farther apart than the rounding of 2.
    const double s = 12 * unit;
    const TriangleMesh mesh = make({{1, 0, 0},
                                    {1, 1, 1},
                                    {1, 1, 0},
                                    {1 + 2 * s, 0, 0},
                                    {1, -1, 1},
                                    {1, -1, 0},
                                    {1 + s, 0, 0},
                                    {2, 0, 1},
                                    {2, 0, 0}},
                                   {{0, 1, 2}, {3, 4, 5}, {6, 7, 8}});
    CHECK(find_rounding_weld(mesh.positions, mesh.triangles).representative ==
          std::vector<Index>{0, 1, 2, 3, 4, 5, 0, 7, 8});
}

TEST_CASE("faces with a back side of their own are open") {
    TriangleMesh torn = float_soup(icosphere(2), 1);
    const std::vector<Triangle> front = torn.triangles;
    for (const Triangle& t : front) torn.triangles.push_back({t[2], t[1], t[0]});
    CHECK(find_rounding_weld(torn.positions, torn.triangles).welded > 0);
}
