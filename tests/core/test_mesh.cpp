#include "faqem/mesh.hpp"

#include <catch2/catch.hpp>

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
