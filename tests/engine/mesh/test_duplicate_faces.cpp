#include "faqem/engine/mesh/duplicate_faces.hpp"

#include "support/catch.hpp"
#include "support/meshes.hpp"

using namespace faqem;

TEST_CASE("duplicate faces have the same vertices and winding, in any rotation of the corners") {
    TriangleMesh mesh = test::quad();
    mesh.triangles = {{0, 1, 2}, {2, 1, 0}, {1, 2, 0}, {0, 2, 3}, {2, 0, 1}, {0, 2, 1}};
    engine::CollapseMesh collapse_mesh = test::collapse_mesh_of(mesh);
    CHECK(engine::duplicate_faces(collapse_mesh) == std::vector<Index>{2, 4, 5});
    collapse_mesh.remove_face(0);
    collapse_mesh.remove_face(5);
    CHECK(engine::duplicate_faces(collapse_mesh) == std::vector<Index>{4});
    CHECK(engine::duplicate_faces(test::collapse_mesh_of(test::icosphere(1))).empty());
}
