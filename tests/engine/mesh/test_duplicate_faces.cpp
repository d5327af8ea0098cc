#include "faqem/engine/mesh/duplicate_faces.hpp"

#include <catch2/catch.hpp>

#include "support/meshes.hpp"

using namespace faqem;

TEST_CASE("double faces: the same corners and winding count, wherever the list of corners begins") {
    TriangleMesh mesh = test::quad();
    mesh.triangles = {{0, 1, 2}, {2, 1, 0}, {1, 2, 0}, {0, 2, 3}, {2, 0, 1}, {0, 2, 1}};
    engine::Complex complex = test::complex_of(mesh);
    CHECK(engine::double_faces(complex) == std::vector<Index>{2, 4, 5});
    complex.remove_face(0);
    complex.remove_face(5);
    CHECK(engine::double_faces(complex) == std::vector<Index>{4});
    CHECK(engine::double_faces(test::complex_of(test::icosphere(1))).empty());
}
