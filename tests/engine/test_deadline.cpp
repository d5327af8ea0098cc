#include <chrono>

#include "faqem/engine/custom_metric.hpp"
#include "faqem/engine/metric/accumulated.hpp"
#include "faqem/engine/simplify_with.hpp"
#include "faqem/engine/util/run_context.hpp"
#include "support/catch.hpp"
#include "support/meshes.hpp"

using namespace faqem;
using namespace faqem::engine;
using namespace faqem::test;

namespace {

const RunContext::Deadline past = std::chrono::steady_clock::now();
const RunContext::Deadline far_future = past + std::chrono::hours(10'000);

}  // namespace

TEST_CASE("the collapse loop stops at its deadline, unless the target is reached") {
    const TriangleMesh mesh = icosphere(3);
    const auto simplified = [&](std::size_t faces, RunContext::Deadline deadline) {
        return simplify_with(mesh.view(), AccumulatedMetric({}),
                             {.target_faces = faces, .deadline = deadline});
    };
    const CustomResult stopped = simplified(100, past);
    CHECK(stopped.loop.stop == StopReason::reached_time_limit);
    CHECK(stopped.mesh.triangles == mesh.triangles);
    CHECK(simplified(mesh.triangles.size(), past).loop.stop == StopReason::reached_target);
    const CustomResult in_time = simplified(100, far_future),
                       without = simplified(100, RunContext::no_deadline);
    CHECK(in_time.loop.stop == StopReason::reached_target);
    CHECK(in_time.mesh.positions == without.mesh.positions);
    CHECK(in_time.mesh.triangles == without.mesh.triangles);
}

TEST_CASE("collapses that are stopped by the time limit leave a consistent mesh above the target") {
    const TriangleMesh mesh = shaken(icosphere(4), 0.003, 1);
    std::size_t evaluations = 0;
    // Stops in the middle of a collapse, as the distance tracking may: after the first evaluations of all pairs.
    const auto stop_later = [&](const AccumulatedMetric&, const CollapseMesh&, Index, Index, AllowedPosition,
                                const Candidate& found) {
        if (++evaluations == 3 * mesh.triangles.size()) throw Cancelled{StopReason::reached_time_limit};
        return std::optional(found);
    };
    const CustomResult result = simplify_with(mesh.view(), CustomMetric(AccumulatedMetric({}), stop_later),
                                              {.target_faces = 100, .ladder = Ladder::off});
    CHECK(result.loop.stop == StopReason::reached_time_limit);
    CHECK(result.loop.collapses > 0);
    CHECK(result.mesh.triangles.size() > 100);
    // Each collapse of a closed surface removes two faces.
    CHECK(result.mesh.triangles.size() == mesh.triangles.size() - 2 * result.loop.collapses);
}
