#include <algorithm>
#include <catch2/catch.hpp>

#include "support/meshes.hpp"
#include "support/original.hpp"
#include "step_counts/silence.hpp"
#include "faqem/engine/mesh/components.hpp"
#include "faqem/engine/mesh/duplicate_faces.hpp"
#include "faqem/engine/engine.hpp"
#include "faqem/engine/metric/memoryless.hpp"
#include "faqem/engine/queue/sweep_queue.hpp"
#include "faqem/engine/tracking/tracked_metric.hpp"
#include "faqem/engine/mesh/weld.hpp"

using namespace faqem;
using namespace faqem::engine;
using test::longest_silence;
using test::most_steps;
using test::Watch;

namespace {

template <class Metric, class Queue>
std::uint64_t silence_of_engine(const TriangleMesh& mesh, Metric metric, std::size_t target) {
    Complex complex = test::complex_of(mesh);
    PairTable pairs(complex, {});
    Wedges wedges;
    std::vector<std::uint8_t> free(complex.vertex_slots(), 0);
    NoRecorder nothing;
    LoopOptions loop;
    loop.rules = {LinkCondition::by_size, 0.2, 1e-8, -0.9};
    loop.target_faces = target;
    loop.distance_weight = complex.area() / static_cast<double>(target);
    Watch watch;
    loop.progress = watch.progress();
    Engine<Metric, Queue, NoRecorder>(complex, pairs, wedges, free, metric, nothing).run(loop);
    return watch.longest();
}

}  // namespace

TEST_CASE("polls: no part of the preparations is silent for long") {
    const TriangleMesh mesh = test::icosphere(6);
    const std::vector<Vector3> positions = test::vectors(mesh);
    CHECK(longest_silence([&](Poll poll) { weld_exact(mesh.positions, poll); }) < most_steps);
    CHECK(longest_silence([&](Poll poll) { weld_within(mesh.positions, 1e-6, poll); }) < most_steps);
    CHECK(longest_silence([&](Poll poll) { find_open_edges(mesh.triangles, positions.size(), poll); }) <
          most_steps);
    CHECK(longest_silence([&](Poll poll) { Original(positions, mesh.triangles, poll); }) < most_steps);
    CHECK(longest_silence([&](Poll poll) { Complex(positions, mesh.triangles, poll); }) < most_steps);
    const Complex complex(positions, mesh.triangles);
    CHECK(longest_silence([&](Poll poll) { PairTable(complex, {}, poll); }) < most_steps);
    const PairTable pairs(complex, {});
    CHECK(longest_silence([&](Poll poll) { components(complex, poll); }) < most_steps);
    CHECK(longest_silence([&](Poll poll) { double_faces(complex, poll); }) < most_steps);
    CHECK(longest_silence([&](Poll poll) { BorderLoops(complex, pairs, no_index, poll); }) < most_steps);
    CHECK(longest_silence([&](Poll poll) { MemorylessMetric().initialise(complex, pairs, poll); }) <
          most_steps);
    CHECK(longest_silence([&](Poll poll) { MemoryMetric({}).initialise(complex, pairs, poll); }) <
          most_steps);
}

TEST_CASE("polls: no part of the collapse loop is silent for long") {
    const TriangleMesh mesh = test::shaken(test::icosphere(5), 0.005, 1);
    CHECK(silence_of_engine<MemorylessMetric, RoundQueue>(mesh, MemorylessMetric(), 200) < most_steps);
    CHECK(silence_of_engine<MemoryMetric, HeapQueue>(mesh, MemoryMetric({}), 200) < most_steps);
    const test::OriginalOf original(mesh);
    for (const std::size_t target : {std::size_t{2000}, std::size_t{40}}) {
        CHECK(silence_of_engine<TrackedMetric, RoundQueue>(
                  mesh, TrackedMetric({}, original.surface, original.lineage, target, 0.1), target) <
              most_steps);
    }
}

TEST_CASE("polls: nor is a hub, of which a collapse may touch thousands of pairs") {
    TriangleMesh mesh = test::fan(3000);
    mesh.positions[0][2] = 1;
    CHECK(silence_of_engine<MemoryMetric, HeapQueue>(mesh, MemoryMetric({}), 2000) < most_steps);
}

TEST_CASE("polls: who cancels inside of a collapse finds the complex whole") {
    const TriangleMesh mesh = test::shaken(test::icosphere(4), 0.005, 1);
    for (int stop = 1; stop < 40; stop += 6) {
        Complex complex = test::complex_of(mesh);
        PairTable pairs(complex, {});
        Wedges wedges;
        std::vector<std::uint8_t> free(complex.vertex_slots(), 0);
        NoRecorder nothing;
        MemorylessMetric metric;
        LoopOptions loop;
        loop.target_faces = 100;
        int calls = 0;
        loop.progress = [&](double) { return ++calls == stop ? Continue::cancel : Continue::yes; };
        const LoopResult result =
            Engine<MemorylessMetric, RoundQueue, NoRecorder>(complex, pairs, wedges, free, metric, nothing)
                .run(loop);
        if (result.stop != StopReason::cancelled) break;
        CHECK(calls == stop);
        std::vector<Triangle> left;
        for (Index f = 0; f < complex.face_slots(); ++f) {
            if (complex.alive(f)) left.push_back(complex.triangle(f));
        }
        CHECK(left.size() == complex.face_count());
        CHECK(test::closed_manifold(left));
    }
}
