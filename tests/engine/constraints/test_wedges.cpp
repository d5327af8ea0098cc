#include "faqem/engine/constraints/wedges.hpp"

#include "support/catch.hpp"
#include "support/meshes.hpp"

using namespace faqem;
using namespace faqem::engine;

namespace {

// Two values per corner: x and y, where x is offset by 10 times the chart number of the face.
CornerAttributes charts(const TriangleMesh& mesh, const std::vector<int>& chart) {
    CornerAttributes uv;
    uv.width = 2;
    for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
        for (const Index v : mesh.triangles[f]) {
            uv.values.push_back(static_cast<float>(mesh.positions[v][0] + 10 * chart[f]));
            uv.values.push_back(static_cast<float>(mesh.positions[v][1]));
        }
    }
    return uv;
}

// grid(2) with its faces left of x = 1 in chart 0, the others in chart 1:
//       6 - 7 - 8
//       | / | / |
//       3 - 4 - 5
//       | / | / |
//       0 - 1 - 2
struct Split {
    TriangleMesh mesh = test::grid(2);
    CollapseMesh collapse_mesh = test::collapse_mesh_of(mesh);
    Wedges wedges{collapse_mesh, charts(mesh, {0, 0, 1, 1, 0, 0, 1, 1})};
};

unsigned corner_of(const CollapseMesh& collapse_mesh, Index f, Index v) {
    const Triangle& t = collapse_mesh.triangle(f);
    return t[0] == v ? 0 : t[1] == v ? 1 : 2;
}

}  // namespace

TEST_CASE("wedges: without attributes every position is allowed") {
    const CollapseMesh collapse_mesh = test::collapse_mesh_of(test::quad());
    Wedges none;
    CHECK(none.empty());
    CHECK(none.width() == 0);
    CHECK(none.allowed_position(collapse_mesh, 0, 2) == AllowedPosition::anywhere);
    none.before_collapse(collapse_mesh, 0, 2, {0.5, 0.5, 0});
}

TEST_CASE("wedges: corners with equal values share a wedge and a vertex with two is on a seam") {
    const Split split;
    for (Index v = 0; v < 9; ++v) CHECK(split.wedges.is_seam(split.collapse_mesh, v) == (v % 3 == 1));
    CHECK(split.wedges.width() == 2);
    CHECK(split.wedges.values(3, 1)[0] == 12);
    CHECK(split.wedges.values(3, 1)[1] == 1);
}

TEST_CASE("wedges: a pair of an inner vertex and a seam vertex collapses to the seam vertex") {
    Split split;
    CHECK(split.wedges.allowed_position(split.collapse_mesh, 3, 4) == AllowedPosition::at_second);
    CHECK(split.wedges.allowed_position(split.collapse_mesh, 4, 3) == AllowedPosition::at_first);
    CHECK(split.wedges.allowed_position(split.collapse_mesh, 4, 5) == AllowedPosition::at_first);
    CHECK(split.wedges.allowed_position(split.collapse_mesh, 0, 3) == AllowedPosition::anywhere);
}

TEST_CASE("wedges: a pair along a seam may be collapsed to any position") {
    Split split;
    CHECK(split.wedges.allowed_position(split.collapse_mesh, 1, 4) == AllowedPosition::anywhere);
}

TEST_CASE("wedges: two seams are not merged") {
    // Each of the three columns is a chart: an edge across the middle one connects two seams.
    const TriangleMesh mesh = test::grid(3);
    std::vector<int> chart;
    for (int f = 0; f < 18; ++f) chart.push_back(f / 2 % 3);
    const CollapseMesh collapse_mesh = test::collapse_mesh_of(mesh);
    Wedges wedges(collapse_mesh, charts(mesh, chart));
    CHECK(wedges.allowed_position(collapse_mesh, 5, 6) == AllowedPosition::nowhere);
    CHECK(wedges.allowed_position(collapse_mesh, 5, 9) == AllowedPosition::anywhere);
    CHECK(wedges.allowed_position(collapse_mesh, 4, 5) == AllowedPosition::at_second);
}

TEST_CASE("wedges: a seam that ends inside the surface is not shortened") {
    // Two triangles at the edge (0, 1) with equal values at 0 only: the collapse would merge both wedges of
    // 1.
    const TriangleMesh mesh =
        test::make({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, -1, 0}}, {{0, 1, 2}, {1, 0, 3}});
    const CollapseMesh collapse_mesh = test::collapse_mesh_of(mesh);
    Wedges wedges(collapse_mesh, {{0, 1, 2, 9, 0, 3}, 1});
    CHECK_FALSE(wedges.is_seam(collapse_mesh, 0));
    CHECK(wedges.is_seam(collapse_mesh, 1));
    CHECK(wedges.allowed_position(collapse_mesh, 0, 1) == AllowedPosition::nowhere);
}

TEST_CASE("wedges: a pair without a shared face is not collapsed") {
    const TriangleMesh mesh = test::both(test::quad(), test::moved(test::quad(), {2, 0, 0}));
    const CollapseMesh collapse_mesh = test::collapse_mesh_of(mesh);
    Wedges wedges(collapse_mesh, charts(mesh, {0, 0, 0, 0}));
    CHECK(wedges.allowed_position(collapse_mesh, 1, 4) == AllowedPosition::nowhere);
}

TEST_CASE("wedges: the new vertex has the interpolated values of each side of the seam") {
    Split split;
    const Vector3 p(1, 0.25, 0);
    split.wedges.before_collapse(split.collapse_mesh, 4, 1, p);
    split.collapse_mesh.collapse(4, 1, p);
    std::size_t faces = 0;
    split.collapse_mesh.for_each_face(4, [&](Index f, unsigned corner) {
        const bool right = f / 2 % 2 == 1;
        CHECK(split.wedges.values(f, corner)[0] == (right ? 11 : 1));
        CHECK(split.wedges.values(f, corner)[1] == 0.25f);
        ++faces;
    });
    CHECK(faces == 5);
    CHECK(split.wedges.is_seam(split.collapse_mesh, 4));
}

TEST_CASE("wedges: a position off the edge is interpolated in the face that contains it") {
    TriangleMesh mesh = test::grid(2);
    CollapseMesh collapse_mesh = test::collapse_mesh_of(mesh);
    Wedges wedges(collapse_mesh, charts(mesh, std::vector<int>(8, 0)));
    const Vector3 p(0.75, 0.5, 0);
    wedges.before_collapse(collapse_mesh, 4, 0, p);
    collapse_mesh.collapse(4, 0, p);
    collapse_mesh.for_each_face(4, [&](Index f, unsigned corner) {
        CHECK(wedges.values(f, corner)[0] == 0.75f);
        CHECK(wedges.values(f, corner)[1] == 0.5f);
    });
    CHECK_FALSE(wedges.is_seam(collapse_mesh, 4));
}

TEST_CASE("wedges: the corners of a vertex that does not move keep their values exactly") {
    test::Random random(3);
    for (int round = 0; round < 50; ++round) {
        const TriangleMesh mesh = test::shaken(test::grid(2), 0.3, static_cast<std::uint32_t>(round));
        // One random value per vertex and chart, so that the vertices on the seam have two.
        CornerAttributes uv;
        uv.width = 1;
        std::vector<float> value;
        for (int i = 0; i < 18; ++i) value.push_back(static_cast<float>(random.between(-100, 100)));
        for (Index f = 0; f < 8; ++f) {
            for (const Index v : mesh.triangles[f]) uv.values.push_back(value[v + 9 * (f / 2 % 2)]);
        }
        CollapseMesh collapse_mesh = test::collapse_mesh_of(mesh);
        Wedges wedges(collapse_mesh, uv);
        // 3 is merged into 4, which does not move; the survivor is one or the other.
        const bool swapped = round % 2;
        const Index survivor = swapped ? 3 : 4, removed = swapped ? 4 : 3;
        const Vector3 p = collapse_mesh.position(4);
        wedges.before_collapse(collapse_mesh, survivor, removed, p);
        collapse_mesh.collapse(survivor, removed, p);
        bool same = true;
        collapse_mesh.for_each_face(survivor, [&](Index f, unsigned corner) {
            const Index was = mesh.triangles[f][corner];
            same = same && *wedges.values(f, corner) == value[4 + 9 * (f / 2 % 2)];
            same = same && (was == 3 || was == 4) && corner_of(collapse_mesh, f, survivor) == corner;
        });
        for (Index f = 0; f < 8; ++f) {
            for (unsigned corner = 0; corner < 3 && collapse_mesh.is_alive(f); ++corner) {
                const Index v = collapse_mesh.triangle(f)[corner];
                if (v != survivor) same = same && *wedges.values(f, corner) == value[v + 9 * (f / 2 % 2)];
            }
        }
        CHECK(same);
    }
}

TEST_CASE("wedges: merged wedges whose faces have zero area keep separate values") {
    // Faces of zero area on a line; the seam is along the line, so that two pairs of wedges are merged.
    const TriangleMesh mesh =
        test::make({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}}, {{0, 1, 2}, {1, 0, 3}});
    const CollapseMesh collapse_mesh = test::collapse_mesh_of(mesh);
    Wedges wedges(collapse_mesh, {{1, 2, 3, 12, 11, 13}, 1});
    REQUIRE(wedges.allowed_position(collapse_mesh, 0, 1) == AllowedPosition::anywhere);
    wedges.before_collapse(collapse_mesh, 0, 1, {0.5, 0, 0});
    // Face 0 has the first wedge of vertex 0, face 1 the second.
    CHECK(wedges.values(0, 0)[0] < 5);
    CHECK(wedges.values(1, 1)[0] > 5);
}
