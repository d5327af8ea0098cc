// The parts of the library that make a mesh ready. Their sources are compiled here anew, to be counted.

#include <catch2/catch.hpp>

#include "faqem/detail/simplify/spatial_order.hpp"
#include "support/meshes.hpp"
#include "step_counts/silence.hpp"
#include "faqem/detail/simplify/preprocess.hpp"
#include "faqem/detail/geometry/halfedges.hpp"

using namespace faqem;
using namespace faqem::detail;
using test::longest_silence;
using test::most_steps;

TEST_CASE("polls: no part of reading and arranging a mesh is silent for long") {
    const TriangleMesh mesh = test::icosphere(6);
    Settings settings = detail::settings({});
    for (const double distance : {0.0, 1e-6}) {
        settings.weld_distance = distance;
        CHECK(longest_silence([&](engine::Poll poll) { prepare(mesh.view(), settings, poll); }) < most_steps);
    }
    settings.prune = of_diagonal(0.01);
    CHECK(longest_silence([&](engine::Poll poll) { prepare(mesh.view(), settings, poll); }) < most_steps);
    const Prepared prepared = prepare(mesh.view(), settings);
    CHECK(longest_silence([&](engine::Poll poll) { arrange(prepared, poll); }) < most_steps);
    CHECK(longest_silence([&](engine::Poll poll) { sorted_sides(mesh.triangles, poll); }) < most_steps);
}

TEST_CASE("polls: nor is it with thousands of faces twice, or around one vertex") {
    TriangleMesh mesh = test::fan(50'000);
    mesh.triangles.insert(mesh.triangles.end(), mesh.triangles.begin(), mesh.triangles.end());
    const Settings settings = detail::settings({});
    CHECK(longest_silence([&](engine::Poll poll) { prepare(mesh.view(), settings, poll); }) < most_steps);
}
