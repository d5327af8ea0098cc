#include "faqem/detail/simplify/spatial_order.hpp"

#include <algorithm>

#include "support/catch.hpp"
#include "support/meshes.hpp"

using namespace faqem;
using detail::ReorderedMesh;

namespace {

ReorderedMesh arranged(const TriangleMesh& mesh) {
    return detail::reorder(detail::preprocess(mesh.view(), detail::settings({})));
}

// Positions of the corners of all faces, independent of the vertex numbering.
std::vector<Vec3> face_corners(const std::vector<engine::Vector3>& positions,
                               const std::vector<Triangle>& triangles) {
    std::vector<Vec3> all;
    for (const Triangle& t : triangles) {
        for (const Index v : t) all.push_back(engine::to_array(positions[v]));
    }
    return all;
}

}  // namespace

TEST_CASE("spatial order: slots map to the preprocessed mesh and faces keep their winding") {
    const TriangleMesh mesh = test::shaken(test::torus(9, 7), 0.1, 1);
    const detail::PreprocessedMesh prepared = detail::preprocess(mesh.view(), detail::settings({}));
    const std::vector<engine::Vector3> positions = prepared.engine_positions();
    const ReorderedMesh a = detail::reorder(prepared);
    REQUIRE(a.positions.size() == mesh.positions.size());
    REQUIRE(a.triangles.size() == mesh.triangles.size());
    for (Index v = 0; v < a.positions.size(); ++v) CHECK(a.positions[v] == positions[a.vertex[v]]);
    for (Index f = 0; f < a.triangles.size(); ++f) {
        for (std::size_t k = 0; k < 3; ++k)
            CHECK(a.vertex[a.triangles[f][k]] == prepared.triangles[a.face[f]][k]);
    }
    std::vector<Index> faces = a.face;
    std::sort(faces.begin(), faces.end());
    CHECK(std::adjacent_find(faces.begin(), faces.end()) == faces.end());
}

TEST_CASE("spatial order: elements along a line are sorted along the line") {
    // Quads in a row; those at even positions come first in the input.
    TriangleMesh mesh;
    for (const Index parity : {0u, 1u}) {
        for (Index x = parity; x < 16; x += 2) {
            const auto v = static_cast<Index>(mesh.positions.size());
            mesh = test::both(mesh, test::moved(test::scaled(test::quad(), 0.5), {double(x), 0, 0}));
            REQUIRE(v == mesh.positions.size() - 4);
        }
    }
    const ReorderedMesh a = arranged(mesh);
    for (std::size_t i = 4; i < a.positions.size(); ++i) CHECK(a.positions[i - 4].x() < a.positions[i].x());
    for (std::size_t f = 2; f < a.triangles.size(); ++f) CHECK(a.triangles[f - 2][0] < a.triangles[f][0]);
}

TEST_CASE("spatial order: the reordered mesh does not depend on the vertex order of the input") {
    const TriangleMesh mesh = test::shaken(test::icosphere(2), 0.05, 3);
    TriangleMesh turned = mesh;
    std::reverse(turned.positions.begin(), turned.positions.end());
    for (Triangle& t : turned.triangles) {
        for (Index& v : t) v = static_cast<Index>(mesh.positions.size()) - 1 - v;
    }
    const ReorderedMesh a = arranged(mesh), b = arranged(turned);
    CHECK(face_corners(a.positions, a.triangles) == face_corners(b.positions, b.triangles));
}

TEST_CASE("spatial order: unreferenced vertices and removed faces have no slot") {
    TriangleMesh mesh = test::quad();
    mesh.positions.push_back({1e30, 0, 0});
    mesh.triangles.insert(mesh.triangles.begin(), {2, 2, 3});
    const ReorderedMesh a = arranged(mesh);
    CHECK(a.vertex.size() == 4);
    CHECK(a.face.size() == 2);
    CHECK(std::count(a.face.begin(), a.face.end(), 0u) == 0);
    CHECK(arranged({}).triangles.empty());
}

TEST_CASE("spatial order: per_face reorders values with their faces") {
    TriangleMesh mesh = test::fan(5);
    std::vector<float> values;
    for (Index f = 0; f < 5; ++f) values.insert(values.end(), {float(f), 10 + float(f)});
    const ReorderedMesh a = arranged(mesh);
    const std::vector<float> moved = a.per_face<float>(values, 2);
    REQUIRE(moved.size() == 10);
    for (std::size_t f = 0; f < 5; ++f) {
        CHECK(moved[2 * f] == float(a.face[f]));
        CHECK(moved[2 * f + 1] == 10 + float(a.face[f]));
    }
    CHECK(a.per_face<Index>({}).empty());
}
