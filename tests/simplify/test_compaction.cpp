#include "faqem/detail/simplify/compaction.hpp"

#include "support/catch.hpp"
#include "support/meshes.hpp"

using namespace faqem;
using namespace faqem::detail;
using engine::Vector3;

TEST_CASE("SlotTrace follows merged slots and slots with original positions") {
    SlotTrace trace(5);
    const Vector3 a(0, 0, 0), b(1, 0, 0), c(2, 0, 0), middle(0.5, 0, 0);
    trace.before_collapse(0, 1, a, b, b);  // to the position of the removed vertex
    CHECK(trace.source_slots() == std::vector<Index>{1, 1, 2, 3, 4});
    trace.before_collapse(3, 2, b, c, b);  // to the position of the survivor
    CHECK(trace.source_slots()[3] == 3);
    trace.before_collapse(3, 0, b, a, middle);
    CHECK(trace.source_slots()[3] == no_index);
    for (const Index v : {0u, 1u, 2u, 3u}) CHECK(trace.root(v) == 3);
    CHECK(trace.root(4) == 4);
}

TEST_CASE("compaction numbers the remaining vertices and faces consecutively") {
    engine::CollapseMesh mesh = test::collapse_mesh_of(test::grid(2));
    SlotTrace trace(mesh.vertex_slots());
    const Vector3 to = mesh.position(1);
    trace.before_collapse(1, 4, mesh.position(1), mesh.position(4), to);
    mesh.collapse(1, 4, to);
    const CompactedMesh left = compacted(mesh, trace);
    CHECK(left.vertices == std::vector<Index>{0, 1, 2, 3, 5, 6, 7, 8});
    CHECK(left.vertex_map == std::vector<Index>{0, 1, 2, 3, 1, 4, 5, 6, 7});
    CHECK(left.source_slots == left.vertices);
    CHECK(left.triangles.size() == mesh.face_count());
    CHECK(left.faces.size() == mesh.face_count());
    for (std::size_t i = 0; i < left.faces.size(); ++i) {
        for (const std::size_t corner : {0u, 1u, 2u})
            CHECK(left.vertices[left.triangles[i][corner]] == mesh.triangle(left.faces[i])[corner]);
    }
    for (std::size_t v = 0; v < left.vertices.size(); ++v)
        CHECK(left.positions[v] == mesh.position(left.vertices[v]));
}

TEST_CASE("compaction maps vertices without remaining faces to no_index") {
    engine::CollapseMesh mesh = test::collapse_mesh_of(test::both(test::quad(), test::tetrahedron()));
    SlotTrace trace(mesh.vertex_slots());
    for (Index f = 0; f < 2; ++f) mesh.remove_face(f);
    const CompactedMesh left = compacted(mesh, trace);
    CHECK(left.vertex_map == std::vector<Index>{no_index, no_index, no_index, no_index, 0, 1, 2, 3});
    CHECK(left.faces == std::vector<Index>{2, 3, 4, 5});
}
