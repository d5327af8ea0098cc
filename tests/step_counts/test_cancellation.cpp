#include "faqem/engine/engine.hpp"
#include "faqem/engine/metric/memoryless.hpp"
#include "faqem/engine/queue/bucket_queue.hpp"
#include "faqem/engine/tracking/tracked_metric.hpp"
#include "step_counts/silence.hpp"
#include "support/catch.hpp"
#include "support/meshes.hpp"
#include "support/original.hpp"

using namespace faqem;
using namespace faqem::engine;
using test::for_a_million_faces;
using test::most_steps;
using test::Watch;

namespace {

template <class Queue, class Metric>
std::uint64_t silence_of_engine(const TriangleMesh& mesh, std::size_t target, Watch& watch, Metric metric) {
    CollapseMesh collapse_mesh = test::collapse_mesh_of(mesh);
    PairTable pairs(collapse_mesh, {});
    Wedges wedges;
    std::vector<std::uint8_t> free(collapse_mesh.vertex_slots(), 0);
    NoRecorder nothing;
    LoopOptions loop;
    loop.rules = {LinkCondition::by_size, 0.2, 1e-8, -0.9};
    loop.target_faces = target;
    loop.distance_weight = collapse_mesh.area() / static_cast<double>(target);
    watch.start();
    loop.progress = watch.progress();
    Engine<Metric, Queue, NoRecorder>(collapse_mesh, pairs, wedges, free, metric, nothing).run(loop);
    return watch.longest();
}

}  // namespace

TEST_CASE("cancellation is checked often while an engine runs") {
    const TriangleMesh mesh = test::shaken(test::icosphere(5), 0.005, 1);
    const std::size_t faces = mesh.triangles.size();
    Watch memoryless, accumulated;
    const std::uint64_t buckets = silence_of_engine<BucketQueue>(mesh, 200, memoryless, MemorylessMetric());
    CHECK(for_a_million_faces(buckets, faces) < most_steps);
    const std::uint64_t heap = silence_of_engine<HeapQueue>(mesh, 200, accumulated, AccumulatedMetric({}));
    CHECK(for_a_million_faces(heap, faces) < most_steps);
    const test::OriginalOf original(mesh);
    for (const std::size_t target : {std::size_t{2000}, std::size_t{40}}) {
        Watch watch;
        const std::uint64_t tracked = silence_of_engine<BucketQueue>(
            mesh, target, watch,
            TrackedMetric({}, original.surface, original.tracked, target, 0.1, nullptr, watch.context()));
        CHECK(for_a_million_faces(tracked, faces) < most_steps);
    }
}

TEST_CASE("cancellation is checked often at a vertex with thousands of pairs") {
    TriangleMesh mesh = test::fan(3000);
    mesh.positions[0][2] = 1;
    Watch watch;
    CHECK(silence_of_engine<HeapQueue>(mesh, 2000, watch, AccumulatedMetric({})) < most_steps);
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
        const LoopResult result = Engine<MemorylessMetric, BucketQueue, NoRecorder>(
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
