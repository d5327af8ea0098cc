#include "faqem/engine/mesh/components.hpp"

#include <limits>
#include <vector>

#include "support/catch.hpp"
#include "support/meshes.hpp"

using namespace faqem;
using namespace faqem::engine;

TEST_CASE("faces that share a vertex are one component, coincident faces without shared vertices are two") {
    CHECK(components(test::collapse_mesh_of(test::bow_tie())).size() == 1);
    CHECK(components(test::collapse_mesh_of(test::both(test::quad(), test::quad()))).size() == 2);
}

TEST_CASE("components are ordered by their smallest face and have ascending faces and a bounding box") {
    TriangleMesh mesh = test::both(test::quad(), test::moved(test::scaled(test::quad(), 2), {5, 5, 5}));
    std::swap(mesh.triangles[0], mesh.triangles[2]);  // faces 1, 2: first quad; 0, 3: second quad
    const auto parts = components(test::collapse_mesh_of(mesh));
    REQUIRE(parts.size() == 2);
    CHECK(parts[0].faces == std::vector<Index>{0, 3});
    CHECK(parts[1].faces == std::vector<Index>{1, 2});
    CHECK(parts[0].box.min() == Vector3(5, 5, 5));
    CHECK(parts[0].box.max() == Vector3(7, 7, 5));
    CHECK(parts[1].box.diagonal().norm() == Approx(std::sqrt(2.0)));
}

TEST_CASE("removed faces do not connect components") {
    CollapseMesh collapse_mesh = test::collapse_mesh_of(test::grid(1));
    CHECK(components(collapse_mesh).size() == 1);
    CollapseMesh strip = test::collapse_mesh_of(test::cylinder(8, 1, 1));
    strip.remove_face(0);
    strip.remove_face(1);
    strip.remove_face(8);
    strip.remove_face(9);
    CHECK(components(strip).size() == 2);
    collapse_mesh.remove_face(0);
    collapse_mesh.remove_face(1);
    CHECK(components(collapse_mesh).empty());
}

TEST_CASE("removable components are sorted by size, without the largest and those with locked vertices") {
    // Four quads with edge lengths 3, 1, 4, 2; vertices 0-3, 4-7, 8-11, 12-15.
    const auto quad_of = [](double size, double at) {
        return test::moved(test::scaled(test::quad(), size), {at, 0, 0});
    };
    const CollapseMesh collapse_mesh = test::collapse_mesh_of(
        test::both(test::both(quad_of(3, 0), quad_of(1, 10)), test::both(quad_of(4, 20), quad_of(2, 30))));
    std::vector<std::uint8_t> locked(collapse_mesh.vertex_slots(), 0);
    const auto first_faces = [&](const ComponentSize& largest) {
        std::vector<Index> faces;
        for (const Component& c : removable_components(collapse_mesh, locked, largest))
            faces.push_back(c.faces[0]);
        return faces;
    };
    CHECK(first_faces({}) == std::vector<Index>{2, 6, 0});
    CHECK(first_faces({.diagonal = 3}) == std::vector<Index>{2, 6});  // the diagonals are 1.4, 2.8, 4.2
    CHECK(first_faces({.area = 4.5}) == std::vector<Index>{2, 6});    // the areas are 1, 4, 9
    CHECK(first_faces({.diagonal = std::numeric_limits<double>::quiet_NaN()}).empty());
    CHECK(first_faces({.area = std::numeric_limits<double>::quiet_NaN()}).empty());
    locked[14] = 1;
    CHECK(first_faces({}) == std::vector<Index>{2, 0});
}

TEST_CASE("a component of zero area is the first removable one regardless of its length") {
    // A face of zero area and length 100, and quads with edge lengths 1 and 2.
    const TriangleMesh line = test::make({{0, 0, 0}, {50, 0, 0}, {100, 0, 0}}, {{0, 1, 2}});
    const CollapseMesh collapse_mesh = test::collapse_mesh_of(
        test::both(test::both(test::quad(), line), test::moved(test::scaled(test::quad(), 2), {0, 5, 0})));
    const std::vector<std::uint8_t> locked(collapse_mesh.vertex_slots(), 0);
    const auto found = removable_components(collapse_mesh, locked, {});
    REQUIRE(found.size() == 2);
    CHECK(found[0].faces == std::vector<Index>{2});
    CHECK(found[1].faces == std::vector<Index>{0, 1});
}
