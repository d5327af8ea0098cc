#include "faqem/engine/mesh/components.hpp"

#include <catch2/catch.hpp>
#include <limits>
#include <vector>

#include "support/meshes.hpp"

using namespace faqem;
using namespace faqem::engine;

TEST_CASE("faces joined by one vertex are one component, faces that only lie close are two") {
    CHECK(components(test::collapse_mesh_of(test::bow_tie())).size() == 1);
    CHECK(components(test::collapse_mesh_of(test::both(test::quad(), test::quad()))).size() == 2);
}

TEST_CASE("components come by their smallest face, with their faces and boxes") {
    TriangleMesh mesh = test::both(test::quad(), test::moved(test::scaled(test::quad(), 2), {5, 5, 5}));
    std::swap(mesh.triangles[0], mesh.triangles[2]);  // faces 1, 2 of the first; 0, 3 of the second
    const auto parts = components(test::collapse_mesh_of(mesh));
    REQUIRE(parts.size() == 2);
    CHECK(parts[0].faces == std::vector<Index>{0, 3});
    CHECK(parts[1].faces == std::vector<Index>{1, 2});
    CHECK(parts[0].box.min() == Vector3(5, 5, 5));
    CHECK(parts[0].box.max() == Vector3(7, 7, 5));
    CHECK(parts[1].box.diagonal().norm() == Approx(std::sqrt(2.0)));
}

TEST_CASE("dead faces join nothing") {
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

TEST_CASE("expendable are the small components: not the largest, none with a locked vertex, smallest first") {
    // Four quads, of sizes 3, 1, 4, 2; vertices 0-3, 4-7, 8-11, 12-15.
    const auto quad_of = [](double size, double at) {
        return test::moved(test::scaled(test::quad(), size), {at, 0, 0});
    };
    const CollapseMesh collapse_mesh = test::collapse_mesh_of(
        test::both(test::both(quad_of(3, 0), quad_of(1, 10)), test::both(quad_of(4, 20), quad_of(2, 30))));
    std::vector<std::uint8_t> locked(collapse_mesh.vertex_slots(), 0);
    const auto first_faces = [&](double largest_diagonal) {
        std::vector<Index> faces;
        for (const Component& c : removable_components(collapse_mesh, locked, largest_diagonal))
            faces.push_back(c.faces[0]);
        return faces;
    };
    CHECK(first_faces(100) == std::vector<Index>{2, 6, 0});
    CHECK(first_faces(3) == std::vector<Index>{2, 6});  // the diagonals are 1.4, 2.8, 4.2
    CHECK(first_faces(std::numeric_limits<double>::quiet_NaN()).empty());
    locked[14] = 1;
    CHECK(first_faces(100) == std::vector<Index>{2, 0});
}

TEST_CASE("a long component without area is the most expendable") {
    // A line of length 100 beside quads of sizes 1 and 2.
    TriangleMesh line;
    line.positions = {{0, 0, 0}, {50, 0, 0}, {100, 0, 0}};
    line.triangles = {{0, 1, 2}};
    const CollapseMesh collapse_mesh = test::collapse_mesh_of(
        test::both(test::both(test::quad(), line), test::moved(test::scaled(test::quad(), 2), {0, 5, 0})));
    const std::vector<std::uint8_t> locked(collapse_mesh.vertex_slots(), 0);
    const auto found = removable_components(collapse_mesh, locked, 100);
    REQUIRE(found.size() == 2);
    CHECK(found[0].faces == std::vector<Index>{2});
    CHECK(found[1].faces == std::vector<Index>{0, 1});
}
