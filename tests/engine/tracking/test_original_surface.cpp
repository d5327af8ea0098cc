#include "faqem/engine/tracking/original_surface.hpp"

#include "support/catch.hpp"
#include "support/original.hpp"

using namespace faqem;
using namespace faqem::engine;

TEST_CASE("original surface: the distance to a vertex ring considers the faces of the vertex only") {
    // A fan of six triangles around vertex 0 in the plane z = 0. Vertex 1 has two of them.
    const test::OriginalOf original(test::fan(6));
    CHECK(original.surface.squared_distance_to_ring(0, {0.1, 0.1, 2}, 100) == Approx(4));
    CHECK(original.surface.squared_distance_to_ring(0, {0.1, 0.1, 2}, 1) == 1);
    const Vector3 beyond = -original.positions[1];  // the corner opposite to vertex 1, at distance 1 from 0
    CHECK(original.surface.squared_distance_to_ring(0, beyond, 100) == Approx(0).margin(1e-12));
    CHECK(original.surface.squared_distance_to_ring(1, beyond, 100) > 0.5);
    CHECK(original.surface.boundary_edges().size() == 6);
}

TEST_CASE("original surface: boundary neighbours are ascending, and absent on a closed surface") {
    const test::OriginalOf fan(test::fan(6));
    const auto ends = [&](Index v) {
        const auto all = fan.surface.boundary_neighbours(v);
        return std::vector<Index>(all.begin(), all.end());
    };
    CHECK(ends(0).empty());
    CHECK(ends(1) == std::vector<Index>{2, 6});
    CHECK(ends(3) == std::vector<Index>{2, 4});
    CHECK(ends(6) == std::vector<Index>{1, 5});
    const test::OriginalOf closed(test::cube());
    for (Index v = 0; v < 8; ++v) CHECK(closed.surface.boundary_neighbours(v).empty());
}

TEST_CASE("original surface: vertices without a current vertex are not tracked") {
    const TrackedVertices tracked(std::vector<Index>{4, no_index, 2});
    CHECK(tracked.original == std::vector<Index>{0, 2});
    CHECK(tracked.current == std::vector<Index>{4, 2});
}
