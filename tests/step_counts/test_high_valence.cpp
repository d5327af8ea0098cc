#include <string>

#include "faqem/engine/engine.hpp"
#include "faqem/engine/metric/memoryless.hpp"
#include "faqem/engine/queue/bucket_queue.hpp"
#include "faqem/engine/tracking/tracked_metric.hpp"
#include "step_counts/steps.hpp"
#include "support/catch.hpp"
#include "support/meshes.hpp"
#include "support/original.hpp"

using namespace faqem;
using namespace faqem::engine;

namespace {

// A low cone with the given number of faces around one vertex.
TriangleMesh cone(Index faces) {
    TriangleMesh mesh = test::fan(faces);
    mesh.positions[0][2] = 0.3;
    return test::shaken(mesh, 0.2 / faces, 1);
}

// A cone without a quarter of its faces, so that its apex is on the boundary.
TriangleMesh open_cone(Index faces) {
    TriangleMesh mesh = cone(faces);
    mesh.triangles.resize(faces - faces / 4);
    return mesh;
}

// A fan that is a fold at most of its edges.
TriangleMesh rough_fan(Index faces) { return test::shaken(test::fan(faces), 0.1, 1); }

// Triangles around one vertex that have no edge in common.
TriangleMesh burst(Index faces) {
    TriangleMesh mesh = rough_fan(2 * faces);
    for (Index f = 0; f < faces; ++f) mesh.triangles[f] = mesh.triangles[2 * f];
    mesh.triangles.resize(faces);
    return mesh;
}

// Triangles around one edge.
TriangleMesh sheaf(Index faces) {
    TriangleMesh mesh = rough_fan(faces);
    const auto other = static_cast<Index>(mesh.positions.size());
    mesh.positions.push_back({0, 0, 1});
    for (Triangle& t : mesh.triangles) t[2] = other;
    return mesh;
}

// Two cones with a common rim: an edge from an apex to the rim has a fold at its other end, but is not a
// fold.
TriangleMesh lens(Index faces) {
    TriangleMesh mesh = cone(faces);
    const auto other = static_cast<Index>(mesh.positions.size());
    mesh.positions.push_back({0, 0, -0.3});
    for (Index f = 0; f < faces; ++f) {
        const auto [apex, a, b] = mesh.triangles[f];
        mesh.triangles.push_back({apex == 0 ? other : apex, b, a});
    }
    return mesh;
}

LoopOptions to_a_tenth(const CollapseMesh& collapse_mesh) {
    LoopOptions loop;
    loop.rules = {LinkCondition::by_size, 0.2, 1e-8, -0.9};
    loop.target_faces = collapse_mesh.face_count() / 10;
    loop.distance_weight = collapse_mesh.area() / static_cast<double>(loop.target_faces);
    return loop;
}

template <class Metric>
LoopResult run(CollapseMesh& collapse_mesh, Metric metric) {
    const LoopOptions loop = to_a_tenth(collapse_mesh);
    PairTable pairs(collapse_mesh, {});
    Wedges wedges;
    std::vector<std::uint8_t> free(collapse_mesh.vertex_slots(), 0);
    NoRecorder nothing;
    return Engine<Metric, BucketQueue, NoRecorder>(collapse_mesh, pairs, wedges, free, metric, nothing)
        .run(loop);
}

// Basic blocks per face for a simplification to a tenth of the faces.
double steps_without_memory(const TriangleMesh& mesh) {
    CollapseMesh collapse_mesh = test::collapse_mesh_of(mesh);
    const std::uint64_t before = test::steps();
    CHECK(run(collapse_mesh, MemorylessMetric()).stop == StopReason::reached_target);
    return static_cast<double>(test::steps() - before) / static_cast<double>(mesh.triangles.size());
}

double steps_tracked(const TriangleMesh& mesh) {
    CollapseMesh collapse_mesh = test::collapse_mesh_of(mesh);
    const test::OriginalOf original(mesh);
    const LoopOptions loop = to_a_tenth(collapse_mesh);
    const std::uint64_t before = test::steps();
    TrackedMetric metric({}, original.surface, original.tracked, loop.target_faces, loop.distance_weight);
    const LoopResult result = run(collapse_mesh, std::move(metric));
    CHECK(result.stop == StopReason::reached_target);
    return static_cast<double>(test::steps() - before) / static_cast<double>(mesh.triangles.size());
}

}  // namespace

TEST_CASE("high valence: four times the faces around one vertex need at most 1.5 times the work per face") {
    for (const auto& [name, shape] :
         {std::pair(std::string("cone"), &cone), std::pair(std::string("open cone"), &open_cone),
          std::pair(std::string("lens"), &lens), std::pair(std::string("rough fan"), &rough_fan),
          std::pair(std::string("burst"), &burst)}) {
        INFO(name);
        CHECK(steps_without_memory(shape(8000)) < 1.5 * steps_without_memory(shape(2000)));
        CHECK(steps_tracked(shape(8000)) < 1.5 * steps_tracked(shape(2000)));
    }
}

TEST_CASE("high valence: collapses at a vertex with many faces wait until its valence has decreased") {
    // In a flat fan all pairs at the hub have the cost 0 and most of them are illegal.
    const auto steps_accumulated = [](Index faces) {
        CollapseMesh mesh = test::collapse_mesh_of(test::fan(faces));
        const std::uint64_t before = test::steps();
        CHECK(run(mesh, AccumulatedMetric({})).stop == StopReason::reached_target);
        return static_cast<double>(test::steps() - before) / faces;
    };
    CHECK(steps_accumulated(8000) < 1.5 * steps_accumulated(2000));
    CHECK(steps_without_memory(test::fan(8000)) < 1.5 * steps_without_memory(test::fan(2000)));
    CHECK(steps_tracked(test::fan(8000)) < 1.5 * steps_tracked(test::fan(2000)));
}

TEST_CASE("high valence: four times the faces around one edge need at most five times the work per face") {
    CHECK(steps_without_memory(sheaf(1600)) < 5 * steps_without_memory(sheaf(400)));
    CHECK(steps_tracked(sheaf(1600)) < 5 * steps_tracked(sheaf(400)));
}
