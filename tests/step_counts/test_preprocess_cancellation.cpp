// Cancellation checks in the preprocessing of a mesh and in the search tree, whose sources are compiled into this
// program with instrumentation.

#include "faqem/detail/geometry/bvh.hpp"
#include "faqem/detail/simplify/preprocess.hpp"
#include "faqem/options.hpp"
#include "step_counts/silence.hpp"
#include "support/catch.hpp"
#include "support/meshes.hpp"

using namespace faqem;
using namespace faqem::detail;
using test::for_a_million_faces;
using test::longest_silence;
using test::most_steps;

namespace {

std::uint64_t silence_of_preprocessing(const TriangleMesh& mesh, const Settings& settings) {
    const std::uint64_t steps = longest_silence(
        [&](const engine::RunContext& context) { preprocess(mesh.view(), settings, context); });
    return for_a_million_faces(steps, mesh.triangles.size());
}

}  // namespace

TEST_CASE("cancellation is checked often during the preprocessing of a mesh") {
    const TriangleMesh mesh = test::icosphere(6);
    Settings settings = detail::settings({});
    for (const double distance : {0.0, 1e-6}) {
        settings.weld_distance = distance;
        CHECK(silence_of_preprocessing(mesh, settings) < most_steps);
    }
    settings.prune = of_diagonal(0.01);
    CHECK(silence_of_preprocessing(mesh, settings) < most_steps);
}

TEST_CASE("cancellation is checked often with thousands of duplicate faces and around one vertex") {
    TriangleMesh mesh = test::fan(50'000);
    mesh.triangles.insert(mesh.triangles.end(), mesh.triangles.begin(), mesh.triangles.end());
    CHECK(silence_of_preprocessing(mesh, detail::settings({})) < most_steps);
}

TEST_CASE("cancellation is checked often while a search tree is built") {
    const TriangleMesh mesh = test::icosphere(6);
    const std::uint64_t steps = longest_silence(
        [&](const engine::RunContext& context) { Bvh(mesh.positions, mesh.triangles, context); });
    CHECK(for_a_million_faces(steps, mesh.triangles.size()) < most_steps);
}
