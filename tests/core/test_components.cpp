#include "faqem/engine/components.hpp"

#include <catch2/catch.hpp>

#include "core/meshes.hpp"

using namespace faqem;
using namespace faqem::engine;

TEST_CASE("faces joined by one vertex are one component, faces that only lie close are two") {
    CHECK(components(test::complex_of(test::bow_tie())).size() == 1);
    CHECK(components(test::complex_of(test::both(test::quad(), test::quad()))).size() == 2);
}

TEST_CASE("components come by their smallest face, with their faces and boxes") {
    TriangleMesh mesh = test::both(test::quad(), test::moved(test::scaled(test::quad(), 2), {5, 5, 5}));
    std::swap(mesh.triangles[0], mesh.triangles[2]);  // faces 1, 2 of the first; 0, 3 of the second
    const auto parts = components(test::complex_of(mesh));
    REQUIRE(parts.size() == 2);
    CHECK(parts[0].faces == std::vector<Index>{0, 3});
    CHECK(parts[1].faces == std::vector<Index>{1, 2});
    CHECK(parts[0].box.min() == Vector3(5, 5, 5));
    CHECK(parts[0].box.max() == Vector3(7, 7, 5));
    CHECK(parts[1].box.diagonal().norm() == Approx(std::sqrt(2.0)));
}

TEST_CASE("dead faces join nothing") {
    Complex complex = test::complex_of(test::grid(1));
    CHECK(components(complex).size() == 1);
    Complex strip = test::complex_of(test::cylinder(8, 1, 1));
    strip.remove_face(0);
    strip.remove_face(1);
    strip.remove_face(8);
    strip.remove_face(9);
    CHECK(components(strip).size() == 2);
    complex.remove_face(0);
    complex.remove_face(1);
    CHECK(components(complex).empty());
}
