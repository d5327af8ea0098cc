#include "faqem/mesh.hpp"

#include <catch2/catch.hpp>
#include <cstring>
#include <vector>

#include "faqem/simplify.hpp"
#include "support/meshes.hpp"

using namespace faqem;

TEST_CASE("positions are seen as float or double, as triples or flat, without a copy") {
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

TEST_CASE("trailing numbers that make no vertex or triangle are ignored") {
    const std::vector<double> seven(7, 1.0);
    CHECK(PositionView(seven).size() == 2);
    const std::vector<Index> eight = {0, 1, 2, 3, 4, 5, 6, 7};
    CHECK(TriangleView(eight).size() == 2);
    CHECK(TriangleView(eight)[1] == Triangle{3, 4, 5});
}

TEST_CASE("views of nothing are empty") {
    CHECK(PositionView().empty());
    CHECK(TriangleView().empty());
    CHECK(PositionView(std::vector<Vec3>{}).empty());
    CHECK(TriangleView(std::vector<Triangle>{}).empty());
}

TEST_CASE("a mesh shows its arrays, and its attributes where it has some") {
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

// A vertex as a renderer has it.
struct Drawn {
    float normal[3];
    float place[3];
    std::uint8_t colour[4];
};
const std::vector<Vec3> corners = {{0, 0, 0}, {1, 0, 0}, {1, 2, 0}, {0, 2, 0.5}};
const std::vector<Triangle> faces = {{0, 1, 2}, {0, 2, 3}};

void check_corners(const PositionView& view) {
    REQUIRE(view.size() == corners.size());
    for (std::size_t v = 0; v < corners.size(); ++v) CHECK(view[v] == corners[v]);
}

void check_faces(const TriangleView& view) {
    REQUIRE(view.size() == faces.size());
    for (std::size_t f = 0; f < faces.size(); ++f) CHECK(view[f] == faces[f]);
}

}  // namespace

TEST_CASE("positions are seen between other data") {
    std::vector<Drawn> drawn;
    for (const Vec3& p : corners)
        drawn.push_back({{7, 7, 7}, {float(p[0]), float(p[1]), float(p[2])}, {9, 9, 9, 9}});
    check_corners({drawn[0].place, drawn.size(), sizeof(Drawn)});
}

TEST_CASE("positions are seen one coordinate after the other, as matrices have them") {
    std::vector<double> columns;
    for (std::size_t k = 0; k < 3; ++k) {
        for (const Vec3& p : corners) columns.push_back(p[k]);
    }
    check_corners({columns.data(), corners.size(), sizeof(double), corners.size() * sizeof(double)});
}

TEST_CASE("positions need not be aligned") {
    std::vector<unsigned char> bytes(1 + corners.size() * sizeof(Vec3));
    std::memcpy(bytes.data() + 1, corners.data(), corners.size() * sizeof(Vec3));
    check_corners({reinterpret_cast<const double*>(bytes.data() + 1), corners.size(), sizeof(Vec3)});
}

TEST_CASE("triangles are seen with indices of 16 bits, signed, padded, or corner after corner") {
    const std::vector<std::uint16_t> narrow = {0, 1, 2, 0, 2, 3};
    check_faces(narrow);
    check_faces(std::span(narrow));
    check_faces({narrow.data(), 2, 3 * sizeof(std::uint16_t)});
    const std::vector<std::int32_t> padded = {0, 1, 2, -1, 0, 2, 3, -1};
    check_faces({padded.data(), 2, 4 * sizeof(std::int32_t)});
    const std::vector<Index> columns = {0, 0, 1, 2, 2, 3};
    check_faces({columns.data(), 2, sizeof(Index), 2 * sizeof(Index)});
    const std::vector<std::uint16_t> eight(8, 1);
    CHECK(TriangleView(eight).size() == 2);
}

TEST_CASE("a negative index is out of range") {
    const std::vector<std::int32_t> triangles = {0, 1, 2, 0, -2, 3};
    const MeshView mesh{corners, {triangles.data(), 2, 3 * sizeof(std::int32_t)}};
    CHECK_THROWS_WITH(simplify(mesh), "face 1: vertex index out of range");
}

TEST_CASE("the result does not depend on how the input lies in memory") {
    const TriangleMesh mesh = test::shaken(test::grid(20), 0.2, 3);
    std::vector<double> columns;
    for (std::size_t k = 0; k < 3; ++k) {
        for (const Vec3& p : mesh.positions) columns.push_back(p[k]);
    }
    std::vector<std::uint16_t> narrow;
    for (const Triangle& t : mesh.triangles) {
        for (const Index v : t) narrow.push_back(static_cast<std::uint16_t>(v));
    }
    const std::size_t n = mesh.positions.size();
    const PositionView positions(columns.data(), n, sizeof(double), n * sizeof(double));
    const SimplifyResult a = simplify(mesh.view()), b = simplify({positions, narrow});
    CHECK(a.mesh.positions == b.mesh.positions);
    CHECK(a.mesh.triangles == b.mesh.triangles);
}
