// Cancellation checks in the preprocessing of a mesh, whose sources are compiled into this program with
// instrumentation.

#include "faqem/detail/geometry/halfedges.hpp"
#include "faqem/detail/simplify/preprocess.hpp"
#include "faqem/detail/simplify/spatial_order.hpp"
#include "faqem/options.hpp"
#include "step_counts/silence.hpp"
#include "support/catch.hpp"
#include "support/meshes.hpp"

using namespace faqem;
using namespace faqem::detail;
using test::longest_silence;
using test::most_steps;

TEST_CASE("cancellation is checked often during the preprocessing of a mesh") {
    const TriangleMesh mesh = test::icosphere(6);
    Settings settings = detail::settings({});
    for (const double distance : {0.0, 1e-6}) {
        settings.weld_distance = distance;
        CHECK(longest_silence([&](engine::CancellationCheck check_cancelled) {
                  preprocess(mesh.view(), settings, check_cancelled);
              }) < most_steps);
    }
    settings.prune = of_diagonal(0.01);
    CHECK(longest_silence([&](engine::CancellationCheck check_cancelled) {
              preprocess(mesh.view(), settings, check_cancelled);
          }) < most_steps);
    const PreprocessedMesh prepared = preprocess(mesh.view(), settings);
    CHECK(longest_silence([&](engine::CancellationCheck check_cancelled) {
              reorder(prepared, check_cancelled);
          }) < most_steps);
    CHECK(longest_silence([&](engine::CancellationCheck check_cancelled) {
              sorted_halfedges(mesh.triangles, check_cancelled);
          }) < most_steps);
}

TEST_CASE("cancellation is checked often with thousands of duplicate faces and around one vertex") {
    TriangleMesh mesh = test::fan(50'000);
    mesh.triangles.insert(mesh.triangles.end(), mesh.triangles.begin(), mesh.triangles.end());
    const Settings settings = detail::settings({});
    CHECK(longest_silence([&](engine::CancellationCheck check_cancelled) {
              preprocess(mesh.view(), settings, check_cancelled);
          }) < most_steps);
}
