#pragma once

#include "faqem/export.hpp"
#include "faqem/simplify.hpp"

#include <algorithm>
#include <span>
#include <type_traits>
#include <utility>

#include "faqem/detail/base/stopwatch.hpp"
#include "faqem/detail/fitting/vertex_fitting.hpp"
#include "faqem/detail/geometry/edge_flip.hpp"
#include "faqem/detail/simplify/budget_by_cost.hpp"
#include "faqem/detail/simplify/build_result.hpp"
#include "faqem/detail/simplify/error_bound_search.hpp"
#include "faqem/detail/simplify/preprocess.hpp"
#include "faqem/detail/simplify/presets.hpp"
#include "faqem/detail/simplify/recorders.hpp"
#include "faqem/detail/simplify/run.hpp"
#include "faqem/detail/simplify/run_state.hpp"
#include "faqem/detail/simplify/target.hpp"
#include "faqem/detail/simplify/virtual_edges.hpp"
#include "faqem/engine/constraints/feature_curves.hpp"
#include "faqem/engine/engine.hpp"
#include "faqem/engine/metric/memoryless.hpp"
#include "faqem/engine/metric/weighted.hpp"
#include "faqem/engine/queue/sweep_queue.hpp"
#include "faqem/engine/tracking/tracked_metric.hpp"

FAQEM_NAMESPACE_BEGIN

namespace detail {

// Up to this number of pairs the queue returns the exact minimum.
inline constexpr std::size_t max_exact_pairs = 1 << 17;

using engine::CancellationCheck;
using engine::CollapseMesh;
using engine::Vector3;

// The data that one engine works on, indexed by slots.
struct EngineInput {
    EngineInput(const detail::ReorderedMesh& reordered, CancellationCheck check_cancelled)
        : collapse_mesh(reordered.positions, reordered.triangles, check_cancelled) {}
    EngineInput(const EngineInput&) = delete;

    CollapseMesh collapse_mesh;
    engine::Wedges wedges;
    std::vector<std::uint8_t> locked;
    std::vector<Index> groups;  // referenced by `curves`
    engine::FeatureCurves curves;
    std::vector<double> importance;  // one per vertex slot; empty: uniform
};

// Weight per vertex slot: the largest weight of the input vertices that were welded.
inline std::vector<double> importance(const MeshView& mesh, const detail::PreprocessedMesh& prepared,
                                      const detail::ReorderedMesh& reordered) {
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
template <class Recorder, class ShouldContinue>
engine::LoopResult run(EngineInput& work, engine::PairTable& pairs, const detail::Settings& settings,
                       Recorder& recorder, const engine::LoopOptions& loop, const detail::RunState& state,
                       ShouldContinue&& should_continue) {
    engine::FeatureCurves* curves = work.curves.empty() ? nullptr : &work.curves;
    const auto collapse = [&]<class Queue>(auto metric, Queue queue) {
        engine::Engine<decltype(metric), Queue, Recorder> engine(
            work.collapse_mesh, pairs, work.wedges, work.locked, metric, recorder, curves, std::move(queue));
        engine::LoopResult result = engine.run(loop);
        while (should_continue(result)) result = engine.continue_to(loop);
        return result;
    };
    const auto weighted = [&](auto metric, auto queue) {
        if (work.importance.empty()) return collapse(std::move(metric), std::move(queue));
        return collapse(engine::WeightedMetric(std::move(metric), work.importance), std::move(queue));
    };
    switch (settings.quadric_policy) {
        case detail::Settings::QuadricPolicy::memory: {
            std::vector<std::uint8_t> seam(work.wedges.empty() ? 0 : work.collapse_mesh.vertex_slots());
            for (Index v = 0; v < seam.size(); ++v) seam[v] = work.wedges.is_seam(work.collapse_mesh, v);
            return weighted(engine::AccumulatedMetric(settings.weights, seam, curves), engine::HeapQueue());
        }
        case detail::Settings::QuadricPolicy::memoryless:
            return weighted(engine::MemorylessMetric({}, curves), engine::SweepQueue(max_exact_pairs));
        case detail::Settings::QuadricPolicy::tracked:
            break;
    }
    return weighted(engine::TrackedMetric({}, *state.original(), engine::TrackedVertices(state.vertex_map()),
                                          loop.target_faces, loop.distance_weight, curves),
                    engine::SweepQueue(max_exact_pairs));
}

// One run of simplify(): preprocessing, collapses, fitting, results.
class Run {
public:
    Run(const MeshView& mesh, const Options& options)
        : mesh_(mesh), options_(options), settings_(detail::settings(options)) {
        if (options_.progress) check_cancelled_ = CancellationCheck(monitor_);
    }
    Run(const Run&) = delete;

    std::vector<SimplifyResult> simplify(std::span<const std::uint64_t> targets) {
        targets_ = targets;
        totals_.preset = options_.preset;
        totals_.faces_in = mesh_.triangles.size();
        totals_.vertices_in = mesh_.positions.size();
        try {
            simplify_to_targets();
        } catch (const engine::Cancelled&) {
            SimplifyResult nothing;
            nothing.report = totals_;
            nothing.report.stop = StopReason::cancelled;
            results_.push_back(std::move(nothing));
        }
        return std::move(results_);
    }

    detail::CostCurve curve() {
        const std::uint64_t target = detail::min_target_faces;
        targets_ = {&target, 1};
        try {
            prepare();
            set_target();
            EngineInput work(state_.mesh(), check_cancelled_);
            detail::CostRecorder recorder;
            const engine::LoopResult loop_result =
                collapse(work, recorder, [](const engine::LoopResult&) { return false; });
            return {recorder.take(), work.collapse_mesh.face_count(), settings_.diagonal / prepared_.scale,
                    loop_result.stop != StopReason::cancelled};
        } catch (const engine::Cancelled&) {
            return {{}, 0, 0, false};
        }
    }

private:
    void simplify_to_targets() {
        prepare();
        if (options_.history == Recording::on) {
            engine::HistoryRecorder history(state_.mesh().vertex, state_.mesh().face,
                                            static_cast<Index>(prepared_.positions.size()));
            collapse_to_targets(history);
        } else {
            engine::NoRecorder nothing;
            collapse_to_targets(nothing);
        }
    }

    void prepare() {
        prepared_ = detail::preprocess(mesh_, settings_, check_cancelled_);
        totals_.faces_dropped = prepared_.dropped_faces;
        totals_.seconds.weld = stopwatch_.seconds();
        state_ = detail::RunState(prepared_,
                                  detail::welded_locks(mesh_, prepared_.welded, prepared_.positions.size()),
                                  options_.topology.boundary, check_cancelled_);
        if (options_.history == Recording::off) prepared_.release_triangles();
        if (mesh_.vertex_weights.empty()) prepared_.release_welded();
        if (settings_.fit_vertices) state_.keep_initial_surface();
        if (settings_.quadric_policy == detail::Settings::QuadricPolicy::tracked)
            state_.track_original(check_cancelled_);
        area_ = state_.area();
        loop_.rules = {settings_.link, settings_.min_normal_cosine, min_pair_length(),
                       settings_.min_fold_cosine};
        loop_.tiny_component_diagonal = 0.02 * settings_.diagonal;
        if (options_.progress) {
            loop_.progress = [this](double done) {
                return progress(done_in_blocks_ + (1 - done_in_blocks_) * done);
            };
        }
    }

    // Sets the options of the loop for the next target.
    void set_target() {
        totals_.target_faces = std::max(detail::min_target_faces, targets_[results_.size()]);
        loop_.target_faces = static_cast<std::size_t>(totals_.target_faces);
        if (settings_.quadric_policy != detail::Settings::QuadricPolicy::memory)
            loop_.distance_weight = area_ / static_cast<double>(loop_.target_faces);
        done_in_blocks_ = 0;
    }

    // Reports progress. The share of a target is proportional to the number of faces removed for it.
    Continue progress(double done) {
        const auto gone = [&](std::size_t targets) {
            const double faces = static_cast<double>(mesh_.triangles.size());
            return targets == 0 ? 0 : faces - std::min(faces, static_cast<double>(targets_[targets - 1]));
        };
        const double before = gone(results_.size()), after = gone(results_.size() + 1);
        const double all = gone(targets_.size());
        const double share = all > 0 ? (before + done * (after - before)) / all : done;
        phase_ = Phase::simplify;
        fraction_ = share;
        return options_.progress(phase_, fraction_);
    }

    detail::Workers workers() const { return {options_.threads, check_cancelled_}; }

    double min_pair_length() const { return 1e-8 * settings_.diagonal; }

    // Meshes with attributes, kept groups, weights or virtual edges are not split into blocks.
    bool supports_blocks() const {
        return settings_.quadric_policy != detail::Settings::QuadricPolicy::memory && !mesh_.attributes &&
               mesh_.vertex_weights.empty() && options_.topology.group_boundaries != GroupBoundaries::kept &&
               options_.topology.virtual_edges != VirtualEdges::on;
    }

    // Simplifies in blocks as far as possible and compacts the rest. \return false if cancelled
    template <class Recorder>
    bool simplify_in_blocks_first(Recorder& recorder) {
        if (!supports_blocks()) return true;
        if (!state_.original()) return reduce_in_blocks(loop_.target_faces, nullptr, recorder);
        const engine::OriginalSurface& original = *state_.original();
        const std::size_t far = engine::TrackedMetric::tracking_start_ratio * loop_.target_faces;
        const detail::BlockTracking borders{original, state_.vertex_map(), detail::Watched::borders};
        if (!reduce_in_blocks(far, original.boundary_edges().empty() ? nullptr : &borders, recorder))
            return false;
        const detail::BlockTracking all{original, state_.vertex_map()};
        return reduce_in_blocks(loop_.target_faces, &all, recorder);
    }

    template <class Recorder>
    bool reduce_in_blocks(std::size_t least, const detail::BlockTracking* tracking, Recorder& recorder) {
        const std::size_t faces = state_.mesh().triangles.size();
        if (faces <= least) return true;
        engine::LoopOptions loop = loop_;
        const double share = (1 - done_in_blocks_) * static_cast<double>(faces - least) /
                             static_cast<double>(faces - loop.target_faces);
        if (options_.progress) {
            loop.progress = [&](double done) { return progress(done_in_blocks_ + share * done); };
        }
        // After a first round, smaller surfaces are split as well: tracking distances in parallel saves more
        // time than the faces between blocks cost.
        const std::size_t few =
            has_used_blocks_ ? detail::max_vertices_per_block / 4 : detail::max_vertices_per_block;
        const detail::ReorderedMesh& now = state_.mesh();
        const detail::BlockInput input{now.positions, now.triangles, state_.locked(),
                                       detail::vertices_per_block(now.positions.size(), few)};
        const detail::BlockSteps blocks =
            detail::simplify_in_blocks(input, loop, least, tracking, options_.history, workers());
        if (blocks.is_cancelled) return false;
        if (blocks.steps.empty()) return true;
        has_used_blocks_ = true;
        done_in_blocks_ += share;
        totals_.collapses += blocks.steps.size();
        for (std::size_t i = 0; i < refusal_kinds; ++i) totals_.refusals[i] += blocks.refusals[i];
        for (std::size_t i = 0; i < rung_kinds; ++i) totals_.rungs[i] += blocks.rungs[i];
        detail::CompactedMesh compacted = detail::apply_steps(input, blocks.steps, check_cancelled_);
        if constexpr (std::is_same_v<Recorder, engine::HistoryRecorder>)
            record_blocks(blocks, compacted, recorder);
        state_.advance_to(std::move(compacted));
        return true;
    }

    // Reserves memory for the remaining collapses as well: growing the arrays later would need twice the
    // memory.
    void record_blocks(const detail::BlockSteps& blocks, const detail::CompactedMesh& compacted,
                       engine::HistoryRecorder& recorder) const {
        const double faces_to_go = static_cast<double>(state_.mesh().triangles.size() - loop_.target_faces);
        const double wanted = std::max(faces_to_go / 2, static_cast<double>(blocks.steps.size()));
        const double share = 1.05 * wanted / static_cast<double>(blocks.steps.size());
        recorder.reserve(static_cast<std::size_t>(share * static_cast<double>(blocks.steps.size())),
                         static_cast<std::size_t>(share * static_cast<double>(blocks.patch_faces.size())));
        for (std::size_t i = 0; i < blocks.steps.size(); ++i) {
            const auto& [survivor, gone, to] = blocks.steps[i];
            const std::size_t begin = blocks.patch_begin[i];
            const std::size_t end =
                i + 1 < blocks.steps.size() ? blocks.patch_begin[i + 1] : blocks.patch_faces.size();
            recorder.add_collapse(survivor, gone, to,
                                  std::span(blocks.patch_faces).subspan(begin, end - begin));
        }
        recorder.renumber(compacted.vertices, compacted.faces);
    }

    template <class Recorder, class ShouldContinue>
    engine::LoopResult collapse(EngineInput& work, Recorder& recorder, ShouldContinue&& should_continue) {
        const CollapseMesh& collapse_mesh = work.collapse_mesh;
        std::vector<std::pair<Index, Index>> extra;
        if (options_.topology.virtual_edges == VirtualEdges::on) {
            extra = detail::virtual_edges(collapse_mesh, state_.mesh().per_face(mesh_.face_groups),
                                          options_.topology.virtual_edge_distance * settings_.diagonal,
                                          min_pair_length(), check_cancelled_);
        }
        totals_.virtual_edges = extra.size();
        engine::PairTable pairs(collapse_mesh, extra, check_cancelled_);
        if (mesh_.attributes) {
            const auto [values, width] = *mesh_.attributes;
            work.wedges = engine::Wedges(
                collapse_mesh, {state_.mesh().per_face<float>(values, std::size_t{3} * width), width},
                check_cancelled_);
        }
        work.locked = state_.locked();
        if (options_.topology.group_boundaries == GroupBoundaries::kept) {
            work.groups = state_.mesh().per_face(mesh_.face_groups);
            work.curves = engine::FeatureCurves(collapse_mesh, work.groups, check_cancelled_);
        }
        work.importance = importance(mesh_, prepared_, state_.mesh());
        return run(work, pairs, settings_, recorder, loop_, state_, should_continue);
    }

    // If the mesh may be split into blocks, each target has its own engine, which uses the right distance
    // weight from the start. Otherwise one engine continues from target to target, since it has state that
    // cannot be transferred.
    template <class Recorder>
    void collapse_to_targets(Recorder& recorder) {
        while (results_.size() < targets_.size()) {
            set_target();
            const bool is_cancelled = !simplify_in_blocks_first(recorder);
            EngineInput work(state_.mesh(), check_cancelled_);
            detail::TracingRecorder<Recorder> tracing(recorder, work.collapse_mesh.vertex_slots());
            engine::LoopResult loop_result;
            if (is_cancelled) {
                loop_result.stop = StopReason::cancelled;
                add_result(work, tracing.trace(), recorder, loop_result);
            } else {
                loop_result = collapse(work, tracing, [&](const engine::LoopResult& so_far) {
                    add_result(work, tracing.trace(), recorder, so_far);
                    if (supports_blocks() || is_done()) return false;
                    set_target();
                    return true;
                });
            }
            if (is_done()) return;
            detail::add_counts(loop_result, totals_);
            detail::CompactedMesh left =
                detail::compacted(work.collapse_mesh, tracing.trace(), check_cancelled_);
            if constexpr (std::is_same_v<Recorder, engine::HistoryRecorder>)
                recorder.renumber(left.vertices, left.faces);
            state_.advance_to(std::move(left));
        }
    }

    bool is_done() const {
        return results_.size() == targets_.size() || results_.back().report.stop == StopReason::cancelled;
    }

    // Adds the result of the current target, whether or not it was reached.
    template <class Recorder>
    void add_result(const EngineInput& work, const detail::SlotTrace& trace, Recorder& recorder,
                    const engine::LoopResult& loop_result) {
        SimplifyResult result;
        result.report = totals_;
        detail::add_counts(loop_result, result.report);
        result.report.stop = loop_result.stop;
        const bool is_cancelled = loop_result.stop == StopReason::cancelled;
        const CancellationCheck check_cancelled =
            is_cancelled ? CancellationCheck() : check_cancelled_;  // no callbacks after a cancellation
        const std::vector<Index> slots =
            detail::build_result(mesh_, prepared_, state_.mesh(), work.collapse_mesh, work.wedges,
                                 state_.source_vertices_of(trace.source_slots()), check_cancelled, result);
        if constexpr (std::is_same_v<Recorder, engine::HistoryRecorder>) {
            const bool is_last = results_.size() + 1 == targets_.size();
            result.history = is_last ? recorder.take() : recorder.history();
            for (const Index slot : slots) result.history.kept_versions.push_back(recorder.version(slot));
            detail::to_model_units(prepared_, check_cancelled, result.history.collapses);
            // The arrays are moved into the last result.
            detail::finish_history(mesh_, prepared_.pruned,
                                   is_last ? std::move(prepared_.positions) : prepared_.positions,
                                   is_last ? std::move(prepared_.triangles) : prepared_.triangles, result);
        }
        // Without a collapse the mesh equals the original.
        if (settings_.fit_vertices && !is_cancelled && result.report.collapses > 0)
            fit_vertices(work, slots, result);
        detail::finish_report(options_, settings_, prepared_, result);
        result.report.seconds.simplify = result.report.seconds.total = stopwatch_.seconds();
        stopwatch_ = {};
        totals_.seconds = {};
        results_.push_back(std::move(result));
    }

    // Fits the vertices of the result, in their order. Unreferenced vertices are ignored.
    void fit_vertices(const EngineInput& work, const std::vector<Index>& slots,
                      SimplifyResult& result) const {
        std::vector<Vector3> now;
        std::vector<std::uint8_t> fixed;
        for (const Index v : slots) {
            now.push_back(work.collapse_mesh.position(v));
            const bool is_seam = !work.wedges.empty() && work.wedges.is_seam(work.collapse_mesh, v);
            fixed.push_back(work.locked[v] || is_seam || work.curves.has_vertex(v));
        }
        TriangleMesh& mesh = result.mesh;
        std::vector<Vec3> moved = mesh.positions;
        std::vector<Triangle> triangles = mesh.triangles;
        const detail::MeshRef simplified{now, mesh.triangles};
        detail::FittingResult fitted;
        if (work.wedges.empty()) {
            fitted =
                detail::fit_vertices_and_flip_edges(state_.initial_surface(), simplified, fixed,
                                                    mesh.face_groups, settings_.min_normal_cosine, workers());
        } else {  // no edge flips: they would change the attributes of the corners
            fitted.positions = detail::fit_vertices(state_.initial_surface(), simplified, fixed,
                                                    settings_.min_normal_cosine, workers());
        }
        for (std::size_t v = 0; v < now.size(); ++v) {
            if (fitted.positions[v] == now[v]) continue;
            moved[v] = prepared_.to_model(fitted.positions[v]);
        }
        for (const auto& [s, t] : fitted.flips) detail::flip_edge(triangles[s], triangles[t]);
        if (!detail::revert_degenerate_faces(mesh.positions, triangles, moved)) return;
        for (std::size_t v = 0; v < now.size(); ++v)
            result.report.vertices_fitted += moved[v] != mesh.positions[v];
        mesh.positions = std::move(moved);
        mesh.triangles = std::move(triangles);
        result.report.edges_flipped = fitted.flips.size();
        if (!result.history.empty()) detail::record_fitting(fitted.flips, result);
    }

    const MeshView& mesh_;
    const Options& options_;
    Phase phase_ = Phase::weld;
    double fraction_ = 0;  // of the phase, as last reported
    engine::ProgressMonitor monitor_{[this] { return options_.progress(phase_, fraction_); }};
    CancellationCheck check_cancelled_;  // does nothing without a callback
    detail::Settings settings_;
    detail::PreprocessedMesh prepared_;
    detail::RunState state_;
    engine::LoopOptions loop_;
    double area_ = 0;  // of the original, engine units
    std::span<const std::uint64_t> targets_;
    bool has_used_blocks_ = false;
    double done_in_blocks_ = 0;    // share of the work for the current target that was done in blocks
    detail::Stopwatch stopwatch_;  // since the last target
    Report totals_;                // sums of blocks and of engines that have finished
    std::vector<SimplifyResult> results_;
};

}  // namespace detail

FAQEM_INLINE SimplifyResult simplify(const MeshView& mesh, const Options& options) {
    validate(options);
    if (options.max_error) return detail::simplify_within_error(mesh, options);
    const std::uint64_t target =
        detail::target_face_count(options.target, static_cast<double>(mesh.triangles.size()));
    return std::move(detail::run_to_targets(mesh, {&target, 1}, options).front());
}

FAQEM_INLINE std::vector<SimplifyResult> detail::run_to_targets(const MeshView& mesh,
                                                                std::span<const std::uint64_t> targets,
                                                                const Options& options) {
    return detail::Run(mesh, options).simplify(targets);
}

FAQEM_INLINE detail::CostCurve detail::cost_curve(const MeshView& mesh, const Options& options) {
    Options cheap = options;
    cheap.preset = Preset::fast;
    cheap.weights = {};
    validate(cheap);
    return detail::Run(mesh, cheap).curve();
}

FAQEM_NAMESPACE_END
