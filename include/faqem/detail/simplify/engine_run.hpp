#pragma once
/// \file
/// One run of the collapse engine, with the metric and the queue of a preset.

#include <algorithm>
#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

#include "faqem/detail/geometry/bvh.hpp"
#include "faqem/detail/simplify/preprocess.hpp"
#include "faqem/detail/simplify/presets.hpp"
#include "faqem/detail/simplify/run_recorder.hpp"
#include "faqem/detail/simplify/run_state.hpp"
#include "faqem/detail/simplify/spatial_order.hpp"
#include "faqem/engine/constraints/feature_curves.hpp"
#include "faqem/engine/engine.hpp"
#include "faqem/engine/metric/accumulated.hpp"
#include "faqem/engine/metric/bordered.hpp"
#include "faqem/engine/metric/memoryless.hpp"
#include "faqem/engine/metric/weighted.hpp"
#include "faqem/engine/queue/bucket_queue.hpp"
#include "faqem/engine/queue/heap_queue.hpp"
#include "faqem/engine/tracking/tracked_metric.hpp"
#include "faqem/engine/util/run_context.hpp"
#include "faqem/export.hpp"

FAQEM_DETAIL_BEGIN

using engine::CollapseMesh;
using engine::RunContext;

// Whether a point is within a distance of a surface. Ends at the first near face, which need not be the nearest.
inline bool is_near(const Bvh& tree, const Vector3& p, double distance) {
    bool any = false;
    const auto reject = [&](const Bvh::Corners&) { return !(any = true); };
    tree.closest_if(to_array(p), reject, distance * distance, 1);
    return any;
}

// The data that one engine works on, indexed by slots.
struct EngineInput {
    explicit EngineInput(const ReorderedMesh& reordered)
        : collapse_mesh(reordered.positions, reordered.triangles) {}
    EngineInput(const EngineInput&) = delete;

    CollapseMesh collapse_mesh;
    engine::Wedges wedges;
    std::vector<std::uint8_t> locked;
    std::vector<Index> groups;  // referenced by `curves`
    engine::FeatureCurves curves;
    std::vector<Index> borders;      // see PlanarBorders::at; empty: none
    std::vector<double> importance;  // one per vertex slot; empty: uniform
};

// Weight per vertex slot: the largest weight of the input vertices that were welded.
inline std::vector<double> vertex_importance(const MeshView& mesh, const PreprocessedMesh& prepared,
                                             const ReorderedMesh& reordered) {
    std::vector<double> at_vertex(prepared.positions.size(), 0), result;
    if (mesh.vertex_weights.empty()) return result;
    for (std::size_t v = 0; v < mesh.vertex_weights.size(); ++v) {
        double& weight = at_vertex[prepared.welded[v]];
        weight = std::max<double>(weight, mesh.vertex_weights[v]);
    }
    for (const Index v : reordered.vertex) result.push_back(at_vertex[v]);
    return result;
}

// Runs an engine to the target of `loop`. While should_continue(result) returns true, after which `loop` may
// hold a lower target, continues to that target.
inline engine::LoopResult run_engine(EngineInput& work, engine::PairTable& pairs, const Settings& settings,
                                     RunRecorder& recorder, const engine::LoopOptions& loop, RunState& state,
                                     const RunContext& context,
                                     const std::function<bool(const engine::LoopResult&)>& should_continue,
                                     const engine::DistanceLimit& limit) {
    engine::FeatureCurves* curves = work.curves.empty() ? nullptr : &work.curves;
    const auto collapse = [&]<class Queue>(auto metric, Queue queue) {
        engine::Engine<decltype(metric), Queue, RunRecorder> engine(
            work.collapse_mesh, pairs, work.wedges, work.locked, metric, recorder, curves, std::move(queue));
        engine::LoopResult result = engine.run(loop);
        while (should_continue(result)) result = engine.continue_to(loop);
        return result;
    };
    const auto weighted = [&](auto metric, auto queue) {
        if (work.importance.empty()) return collapse(std::move(metric), std::move(queue));
        return collapse(engine::WeightedMetric(std::move(metric), work.importance), std::move(queue));
    };
    const auto bordered = [&](auto metric) {
        return weighted(engine::BorderedMetric(std::move(metric), state.borders().flats, work.borders,
                                               loop.distance_weight),
                        engine::BucketQueue());
    };
    switch (settings.quadric_policy) {
        case Settings::QuadricPolicy::memory: {
            std::vector<std::uint8_t> seam(work.wedges.empty() ? 0 : work.collapse_mesh.vertex_slots());
            for (Index v = 0; v < seam.size(); ++v) seam[v] = work.wedges.is_seam(work.collapse_mesh, v);
            return weighted(engine::AccumulatedMetric(settings.weights, seam, curves), engine::HeapQueue());
        }
        case Settings::QuadricPolicy::memoryless:
            return bordered(engine::MemorylessMetric({}, curves));
        case Settings::QuadricPolicy::tracked:
            break;
    }
    return bordered(engine::TrackedMetric({}, *state.original(), state.tracked_vertices(), loop.target_faces,
                                          loop.distance_weight, curves, context, limit));
}

FAQEM_DETAIL_END
