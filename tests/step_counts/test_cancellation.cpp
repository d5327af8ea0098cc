#include <algorithm>

#include "faqem/engine/engine.hpp"
#include "faqem/engine/mesh/components.hpp"
#include "faqem/engine/mesh/duplicate_faces.hpp"
#include "faqem/engine/mesh/weld.hpp"
#include "faqem/engine/metric/memoryless.hpp"
#include "faqem/engine/queue/sweep_queue.hpp"
#include "faqem/engine/tracking/tracked_metric.hpp"
#include "step_counts/silence.hpp"
#include "support/catch.hpp"
#include "support/meshes.hpp"
#include "support/original.hpp"

using namespace faqem;
using namespace faqem::engine;
using test::longest_silence;
using test::most_steps;
using test::Watch;

namespace {

template <class Metric, class Queue>
std::uint64_t silence_of_engine(const TriangleMesh& mesh, Metric metric, std::size_t target) {
    CollapseMesh collapse_mesh = test::collapse_mesh_of(mesh);
    PairTable pairs(collapse_mesh, {});
    Wedges wedges;
    std::vector<std::uint8_t> free(collapse_mesh.vertex_slots(), 0);
    NoRecorder nothing;
    LoopOptions loop;
    loop.rules = {LinkCondition::by_size, 0.2, 1e-8, -0.9};
    loop.target_faces = target;
    loop.distance_weight = collapse_mesh.area() / static_cast<double>(target);
    Watch watch;
    loop.progress = watch.progress();
    Engine<Metric, Queue, NoRecorder>(collapse_mesh, pairs, wedges, free, metric, nothing).run(loop);
    return watch.longest();
}

}  // namespace

TEST_CASE("cancellation is checked often during welding and the setup of the engine") {
    const TriangleMesh mesh = test::icosphere(6);
    const std::vector<Vector3> positions = test::vectors(mesh);
    CHECK(longest_silence([&](CancellationCheck check_cancelled) {
              weld_exact(mesh.positions, check_cancelled);
          }) < most_steps);
    CHECK(longest_silence([&](CancellationCheck check_cancelled) {
              weld_within(mesh.positions, 1e-6, check_cancelled);
          }) < most_steps);
    CHECK(longest_silence([&](CancellationCheck check_cancelled) {
              find_boundary_edges(mesh.triangles, positions.size(), check_cancelled);
          }) < most_steps);
    CHECK(longest_silence([&](CancellationCheck check_cancelled) {
              OriginalSurface(positions, mesh.triangles, check_cancelled);
          }) < most_steps);
    CHECK(longest_silence([&](CancellationCheck check_cancelled) {
              CollapseMesh(positions, mesh.triangles, check_cancelled);
          }) < most_steps);
    const CollapseMesh collapse_mesh(positions, mesh.triangles);
    CHECK(longest_silence([&](CancellationCheck check_cancelled) {
              PairTable(collapse_mesh, {}, check_cancelled);
          }) < most_steps);
    const PairTable pairs(collapse_mesh, {});
    CHECK(longest_silence([&](CancellationCheck check_cancelled) {
              components(collapse_mesh, check_cancelled);
          }) < most_steps);
    CHECK(longest_silence([&](CancellationCheck check_cancelled) {
              duplicate_faces(collapse_mesh, check_cancelled);
          }) < most_steps);
    CHECK(longest_silence([&](CancellationCheck check_cancelled) {
              BoundaryLoops(collapse_mesh, pairs, no_index, check_cancelled);
          }) < most_steps);
    CHECK(longest_silence([&](CancellationCheck check_cancelled) {
              MemorylessMetric().initialise(collapse_mesh, pairs, check_cancelled);
          }) < most_steps);
    CHECK(longest_silence([&](CancellationCheck check_cancelled) {
              AccumulatedMetric({}).initialise(collapse_mesh, pairs, check_cancelled);
          }) < most_steps);
}

TEST_CASE("cancellation is checked often during the collapse loop") {
    const TriangleMesh mesh = test::shaken(test::icosphere(5), 0.005, 1);
    CHECK(silence_of_engine<MemorylessMetric, SweepQueue>(mesh, MemorylessMetric(), 200) < most_steps);
    CHECK(silence_of_engine<AccumulatedMetric, HeapQueue>(mesh, AccumulatedMetric({}), 200) < most_steps);
    const test::OriginalOf original(mesh);
    for (const std::size_t target : {std::size_t{2000}, std::size_t{40}}) {
        CHECK(silence_of_engine<TrackedMetric, SweepQueue>(
                  mesh, TrackedMetric({}, original.surface, original.tracked, target, 0.1), target) <
              most_steps);
    }
}

TEST_CASE("cancellation is checked often at a vertex with thousands of pairs") {
    TriangleMesh mesh = test::fan(3000);
    mesh.positions[0][2] = 1;
    CHECK(silence_of_engine<AccumulatedMetric, HeapQueue>(mesh, AccumulatedMetric({}), 2000) < most_steps);
}

TEST_CASE("the mesh is consistent after a cancellation within a collapse") {
    const TriangleMesh mesh = test::shaken(test::icosphere(4), 0.005, 1);
    for (int stop = 1; stop < 40; stop += 6) {
        CollapseMesh collapse_mesh = test::collapse_mesh_of(mesh);
        PairTable pairs(collapse_mesh, {});
        Wedges wedges;
        std::vector<std::uint8_t> free(collapse_mesh.vertex_slots(), 0);
        NoRecorder nothing;
        MemorylessMetric metric;
        LoopOptions loop;
        loop.target_faces = 100;
        int calls = 0;
        loop.progress = [&](double) { return ++calls == stop ? Continue::cancel : Continue::yes; };
        const LoopResult result = Engine<MemorylessMetric, SweepQueue, NoRecorder>(
                                      collapse_mesh, pairs, wedges, free, metric, nothing)
                                      .run(loop);
        if (result.stop != StopReason::cancelled) break;
        CHECK(calls == stop);
        std::vector<Triangle> left;
        for (Index f = 0; f < collapse_mesh.face_slots(); ++f) {
            if (collapse_mesh.is_alive(f)) left.push_back(collapse_mesh.triangle(f));
        }
        CHECK(left.size() == collapse_mesh.face_count());
        CHECK(test::closed_manifold(left));
    }
}
