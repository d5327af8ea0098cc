#include "faqem/mesh.hpp"

#include <cstring>
#include <vector>

#include "faqem/simplify.hpp"
#include "support/catch.hpp"
#include "support/meshes.hpp"

using namespace faqem;

TEST_CASE("PositionView reads float and double, as arrays of triples and as flat arrays, without copying") {
    const std::vector<Vec3> doubles = {{1, 2, 3}, {4, 5, 0.1}};
    const std::vector<Vec3f> floats = {{1, 2, 3}, {4, 5, 0.1f}};
    const std::vector<double> flat = {1, 2, 3, 4, 5, 0.1};
    const std::vector<float> flat_floats = {1, 2, 3, 4, 5, 0.1f};
    for (const PositionView& view : {PositionView(doubles), PositionView(flat)}) {
        CHECK(view.size() == 2);
        CHECK(view[1] == doubles[1]);
    }
    for (const PositionView& view : {PositionView(floats), PositionView(flat_floats)}) {
        CHECK(view.size() == 2);
        CHECK(view[1] == Vec3{4, 5, double(0.1f)});
    }
    std::vector<double> changing = flat;
    const PositionView view(changing);
    changing[0] = 9;
    CHECK(view[0][0] == 9);
}

TEST_CASE("a flat array whose length is no multiple of 3 is an error") {
    CHECK_THROWS_WITH(PositionView(std::vector<double>(7)),
                      "positions: has 7 numbers, which is no multiple of 3");
    CHECK_THROWS_WITH(PositionView(std::span<const float>(std::vector<float>(4))),
                      "positions: has 4 numbers, which is no multiple of 3");
    CHECK_THROWS_WITH(TriangleView(std::vector<int>(8)),
                      "triangles: has 8 numbers, which is no multiple of 3");
    CHECK_THROWS_AS(TriangleView(std::vector<std::uint16_t>(1)), InputError);
}

TEST_CASE("layouts whose numbers overlap are errors, and planar arrays are none") {
    const std::vector<float> p(12);
    CHECK_THROWS_WITH(PositionView(p.data(), 4, 3),
                      "positions: with a stride of 3 bytes and a step of 4 bytes number 0 of element 0 "
                      "overlaps number 0 of "
                      "element 1");
    CHECK_THROWS_AS(PositionView(p.data(), 4, 8), InputError);
    CHECK_THROWS_AS(TriangleView(std::vector<Index>(12).data(), 4, 4), InputError);
    CHECK(PositionView(p.data(), 4, sizeof(float), 4 * sizeof(float)).size() == 4);
}

TEST_CASE("triangles may be arrays of int, flat or as triples") {
    const TriangleMesh mesh = test::grid(6);
    std::vector<int> flat;
    std::vector<std::array<int, 3>> triples;
    for (const Triangle& t : mesh.triangles) {
        triples.push_back({int(t[0]), int(t[1]), int(t[2])});
        flat.insert(flat.end(), triples.back().begin(), triples.back().end());
    }
    const TriangleMesh expected = simplify(mesh.view(), {.target = ratio(0.5)}).mesh;
    CHECK(simplify({mesh.positions, flat}, {.target = ratio(0.5)}).mesh.triangles == expected.triangles);
    CHECK(simplify({mesh.positions, triples}, {.target = ratio(0.5)}).mesh.triangles == expected.triangles);
}

TEST_CASE("default-constructed views and views of empty arrays are empty") {
    CHECK(PositionView().empty());
    CHECK(TriangleView().empty());
    CHECK(PositionView(std::vector<Vec3>{}).empty());
    CHECK(TriangleView(std::vector<Triangle>{}).empty());
}

TEST_CASE("TriangleMesh::view refers to all arrays of the mesh, and to attributes only if there are some") {
    TriangleMesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    mesh.triangles = {{0, 1, 2}};
    mesh.face_groups = {7};
    CHECK(mesh.view().positions.size() == 3);
    CHECK(mesh.view().triangles[0] == Triangle{0, 1, 2});
    CHECK(mesh.view().face_groups[0] == 7);
    CHECK(mesh.view().attributes == nullptr);
    CHECK(mesh.view().vertex_locks.empty());
    mesh.attributes = {{0, 0, 1, 0, 0, 1}, 2};
    CHECK(mesh.view().attributes == &mesh.attributes);
}

namespace {

// An interleaved vertex, as in a vertex buffer.
struct InterleavedVertex {
    float normal[3];
    float position[3];
    std::uint8_t colour[4];
};
const std::vector<Vec3> corner_positions = {{0, 0, 0}, {1, 0, 0}, {1, 2, 0}, {0, 2, 0.5}};
const std::vector<Triangle> two_faces = {{0, 1, 2}, {0, 2, 3}};

void check_corners(const PositionView& view) {
    REQUIRE(view.size() == corner_positions.size());
    for (std::size_t v = 0; v < corner_positions.size(); ++v) CHECK(view[v] == corner_positions[v]);
}

void check_faces(const TriangleView& view) {
    REQUIRE(view.size() == two_faces.size());
    for (std::size_t f = 0; f < two_faces.size(); ++f) CHECK(view[f] == two_faces[f]);
}

}  // namespace

TEST_CASE("PositionView reads interleaved positions") {
    std::vector<InterleavedVertex> vertices;
    for (const Vec3& p : corner_positions)
        vertices.push_back({{7, 7, 7}, {float(p[0]), float(p[1]), float(p[2])}, {9, 9, 9, 9}});
    check_corners({vertices[0].position, vertices.size(), sizeof(InterleavedVertex)});
}

TEST_CASE("PositionView reads column-major matrices with one row per vertex") {
    std::vector<double> columns;
    for (std::size_t k = 0; k < 3; ++k) {
        for (const Vec3& p : corner_positions) columns.push_back(p[k]);
    }
    check_corners(
        {columns.data(), corner_positions.size(), sizeof(double), corner_positions.size() * sizeof(double)});
}

TEST_CASE("PositionView reads unaligned positions") {
    std::vector<unsigned char> bytes(1 + corner_positions.size() * sizeof(Vec3));
    std::memcpy(bytes.data() + 1, corner_positions.data(), corner_positions.size() * sizeof(Vec3));
    check_corners({reinterpret_cast<const double*>(bytes.data() + 1), corner_positions.size(), sizeof(Vec3)});
}

TEST_CASE("TriangleView reads 16-bit, signed, padded and column-major indices") {
    const std::vector<std::uint16_t> narrow = {0, 1, 2, 0, 2, 3};
    check_faces(narrow);
    check_faces(std::span(narrow));
    check_faces({narrow.data(), 2, 3 * sizeof(std::uint16_t)});
    const std::vector<std::int32_t> padded = {0, 1, 2, -1, 0, 2, 3, -1};
    check_faces({padded.data(), 2, 4 * sizeof(std::int32_t)});
    const std::vector<Index> columns = {0, 0, 1, 2, 2, 3};
    check_faces({columns.data(), 2, sizeof(Index), 2 * sizeof(Index)});
}

TEST_CASE("simplify refuses negative vertex indices") {
    const std::vector<std::int32_t> triangles = {0, 1, 2, 0, -2, 3};
    const MeshView mesh{corner_positions, {triangles.data(), 2, 3 * sizeof(std::int32_t)}};
    CHECK_THROWS_WITH(simplify(mesh), "face 1: vertex index -2 is out of range: there are 4 vertices");
}
