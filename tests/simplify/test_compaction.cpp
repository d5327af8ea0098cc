#include "faqem/detail/simplify/compaction.hpp"

#include <catch2/catch.hpp>

#include "support/meshes.hpp"

using namespace faqem;
using namespace faqem::detail;
using engine::Vector3;

TEST_CASE("a trace knows where slots went and whose place they have") {
    SlotTrace trace(5);
    const Vector3 a(0, 0, 0), b(1, 0, 0), c(2, 0, 0), middle(0.5, 0, 0);
    trace.collapsing(0, 1, a, b, b);  // at the place of the one that goes
    CHECK(trace.places() == std::vector<Index>{1, 1, 2, 3, 4});
    trace.collapsing(3, 2, b, c, b);  // stays
    CHECK(trace.places()[3] == 3);
    trace.collapsing(3, 0, b, a, middle);
    CHECK(trace.places()[3] == no_index);
    for (const Index v : {0u, 1u, 2u, 3u}) CHECK(trace.root(v) == 3);
    CHECK(trace.root(4) == 4);
}

TEST_CASE("what an engine has left is numbered anew") {
    engine::Complex complex = test::complex_of(test::grid(2));
    SlotTrace trace(complex.vertex_slots());
    const Vector3 to = complex.position(1);
    trace.collapsing(1, 4, complex.position(1), complex.position(4), to);
    complex.collapse(1, 4, to);
    const Reduced left = reduced(complex, trace);
    CHECK(left.vertices == std::vector<Index>{0, 1, 2, 3, 5, 6, 7, 8});
    CHECK(left.into == std::vector<Index>{0, 1, 2, 3, 1, 4, 5, 6, 7});
    CHECK(left.places == left.vertices);
    CHECK(left.triangles.size() == complex.face_count());
    CHECK(left.faces.size() == complex.face_count());
    for (std::size_t i = 0; i < left.faces.size(); ++i) {
        for (const std::size_t corner : {0u, 1u, 2u})
            CHECK(left.vertices[left.triangles[i][corner]] == complex.triangle(left.faces[i])[corner]);
    }
    for (std::size_t v = 0; v < left.vertices.size(); ++v)
        CHECK(left.positions[v] == complex.position(left.vertices[v]));
}

TEST_CASE("vertices whose faces have all gone have gone into none") {
    engine::Complex complex = test::complex_of(test::both(test::quad(), test::tetrahedron()));
    SlotTrace trace(complex.vertex_slots());
    for (Index f = 0; f < 2; ++f) complex.remove_face(f);
    const Reduced left = reduced(complex, trace);
    CHECK(left.into == std::vector<Index>{no_index, no_index, no_index, no_index, 0, 1, 2, 3});
    CHECK(left.faces == std::vector<Index>{2, 3, 4, 5});
}
