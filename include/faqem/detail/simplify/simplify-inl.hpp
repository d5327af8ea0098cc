#pragma once

#include "faqem/export.hpp"
#include "faqem/simplify.hpp"

#include <algorithm>
#include <span>
#include <type_traits>
#include <utility>

#include "faqem/detail/simplify/build_result.hpp"
#include "faqem/detail/simplify/budget_by_cost.hpp"
#include "faqem/detail/geometry/edge_flip.hpp"
#include "faqem/engine/engine.hpp"
#include "faqem/engine/constraints/feature_curves.hpp"
#include "faqem/engine/metric/weighted.hpp"
#include "faqem/engine/metric/memoryless.hpp"
#include "faqem/engine/queue/sweep_queue.hpp"
#include "faqem/engine/tracking/tracked_metric.hpp"
#include "faqem/detail/simplify/run_state.hpp"
#include "faqem/detail/simplify/preprocess.hpp"
#include "faqem/detail/simplify/presets.hpp"
#include "faqem/detail/fitting/vertex_fitting.hpp"
#include "faqem/detail/simplify/run.hpp"
#include "faqem/detail/simplify/recorders.hpp"
#include "faqem/detail/base/stopwatch.hpp"
#include "faqem/detail/simplify/target.hpp"
#include "faqem/detail/simplify/virtual_edges.hpp"
#include "faqem/detail/simplify/error_bound_search.hpp"

FAQEM_NAMESPACE_BEGIN

namespace detail {

// Up to which the queue is exact.
inline constexpr std::size_t few_pairs = 1 << 17;

using engine::Complex;
using engine::Poll;
using engine::Vector3;

// What the engine works on, in slots.
struct Work {
    Work(const detail::Arranged& arranged, Poll poll)
        : complex(arranged.positions, arranged.triangles, poll) {}
    Work(const Work&) = delete;

    Complex complex;
    engine::Wedges wedges;
    std::vector<std::uint8_t> locked;
    std::vector<Index> groups;  // borrowed by the curves
    engine::GroupCurves curves;
    std::vector<double> importance;  // empty: the same everywhere
};

// Of vertices at one place the largest weight counts.
inline std::vector<double> importance(const MeshView& mesh, const detail::Prepared& prepared,
                               const detail::Arranged& arranged) {
    std::vector<double> at_vertex(prepared.positions.size(), 0), result;
    if (mesh.vertex_weights.empty()) return result;
    for (std::size_t v = 0; v < mesh.vertex_weights.size(); ++v) {
        double& weight = at_vertex[prepared.welded[v]];
        weight = std::max<double>(weight, mesh.vertex_weights[v]);
    }
    for (const Index v : arranged.vertex) result.push_back(at_vertex[v]);
    return result;
}

// Runs to the target of `loop`, and on to what it is then for as long as goes_on(result) says so.
template <class Recorder, class GoesOn>
engine::LoopResult run(Work& work, engine::PairTable& pairs, const detail::Settings& settings,
                       Recorder& recorder, const engine::LoopOptions& loop, const detail::Ground& ground,
                       GoesOn&& goes_on) {
    engine::GroupCurves* curves = work.curves.empty() ? nullptr : &work.curves;
    const auto collapse = [&]<class Queue>(auto metric, Queue queue) {
        engine::Engine<decltype(metric), Queue, Recorder> engine(
            work.complex, pairs, work.wedges, work.locked, metric, recorder, curves, std::move(queue));
        engine::LoopResult result = engine.run(loop);
        while (goes_on(result)) result = engine.go_on(loop);
        return result;
    };
    const auto weighted = [&](auto metric, auto queue) {
        if (work.importance.empty()) return collapse(std::move(metric), std::move(queue));
        return collapse(engine::ImportanceMetric(std::move(metric), work.importance), std::move(queue));
    };
    switch (settings.carry) {
        case detail::Settings::Carry::memory: {
            std::vector<std::uint8_t> seam(work.wedges.empty() ? 0 : work.complex.vertex_slots());
            for (Index v = 0; v < seam.size(); ++v) seam[v] = work.wedges.is_seam(work.complex, v);
            return weighted(engine::MemoryMetric(settings.weights, seam, curves), engine::HeapQueue());
        }
        case detail::Settings::Carry::memoryless:
            return weighted(engine::MemorylessMetric({}, curves), engine::RoundQueue(few_pairs));
        case detail::Settings::Carry::tracked:
            break;
    }
    return weighted(engine::TrackedMetric({}, *ground.original(), engine::Lineage(ground.into()),
                                          loop.target_faces, loop.distance_weight, curves),
                    engine::RoundQueue(few_pairs));
}

// Everything of one run, in the order it is made.
class Run {
public:
    Run(const MeshView& mesh, const Options& options)
        : mesh_(mesh), options_(options), settings_(detail::settings(options)) {
        if (options_.progress) poll_ = Poll(asker_);
    }
    Run(const Run&) = delete;

    std::vector<SimplifyResult> simplify(std::span<const std::uint64_t> targets) {
        targets_ = targets;
        counted_.preset = options_.preset;
        counted_.faces_in = mesh_.triangles.size();
        counted_.vertices_in = mesh_.positions.size();
        try {
            simplify_to_targets();
        } catch (const engine::Cancelled&) {
            SimplifyResult nothing;
            nothing.report = counted_;
            nothing.report.stop = StopReason::cancelled;
            results_.push_back(std::move(nothing));
        }
        return std::move(results_);
    }

    detail::CostCurve curve() {
        const std::uint64_t target = detail::smallest_target;
        targets_ = {&target, 1};
        try {
            prepare();
            aim();
            Work work(ground_.now(), poll_);
            detail::CostRecorder recorder;
            const engine::LoopResult looped =
                collapse(work, recorder, [](const engine::LoopResult&) { return false; });
            return {recorder.take(), work.complex.face_count(), settings_.diagonal / prepared_.scale,
                    looped.stop != StopReason::cancelled};
        } catch (const engine::Cancelled&) {
            return {{}, 0, 0, false};
        }
    }

private:
    void simplify_to_targets() {
        prepare();
        if (options_.history == Recording::on) {
            engine::HistoryRecorder history(ground_.now().vertex, ground_.now().face,
                                            static_cast<Index>(prepared_.positions.size()));
            collapse_to_targets(history);
        } else {
            engine::NoRecorder nothing;
            collapse_to_targets(nothing);
        }
    }

    void prepare() {
        prepared_ = detail::prepare(mesh_, settings_, poll_);
        counted_.faces_dropped = prepared_.dropped_faces;
        counted_.seconds.weld = watch_.seconds();
        ground_ = detail::Ground(prepared_,
                                 detail::locks_of_welded(mesh_, prepared_.welded, prepared_.positions.size()),
                                 options_.topology.border, poll_);
        if (options_.history == Recording::off) prepared_.forget_triangles();
        if (mesh_.vertex_weights.empty()) prepared_.forget_welded();
        if (settings_.relax) ground_.keep_whole();
        if (settings_.carry == detail::Settings::Carry::tracked) ground_.remember_original(poll_);
        area_ = ground_.area();
        loop_.rules = {settings_.link, settings_.least_turn, least_length(), settings_.least_fold};
        loop_.tiny_component = 0.02 * settings_.diagonal;
        if (options_.progress) {
            loop_.progress = [this](double done) {
                return progress(done_in_blocks_ + (1 - done_in_blocks_) * done);
            };
        }
    }

    // At the next target.
    void aim() {
        counted_.target_faces = std::max(detail::smallest_target, targets_[results_.size()]);
        loop_.target_faces = static_cast<std::size_t>(counted_.target_faces);
        if (settings_.carry != detail::Settings::Carry::memory)
            loop_.distance_weight = area_ / static_cast<double>(loop_.target_faces);
        done_in_blocks_ = 0;
    }

    // Targets count by the faces that go on the way to them.
    Continue progress(double done) {
        const auto gone = [&](std::size_t targets) {
            const double faces = static_cast<double>(mesh_.triangles.size());
            return targets == 0 ? 0 : faces - std::min(faces, static_cast<double>(targets_[targets - 1]));
        };
        const double before = gone(results_.size()), after = gone(results_.size() + 1);
        const double all = gone(targets_.size());
        const double share = all > 0 ? (before + done * (after - before)) / all : done;
        phase_ = Phase::simplify;
        share_ = share;
        return options_.progress(phase_, share_);
    }

    detail::Workers workers() const { return {options_.threads, poll_}; }

    double least_length() const { return 1e-8 * settings_.diagonal; }

    // What has attributes, groups, weights or virtual edges is not cut into blocks.
    bool may_be_cut() const {
        return settings_.carry != detail::Settings::Carry::memory && !mesh_.attributes &&
               mesh_.vertex_weights.empty() && options_.topology.group_borders != GroupBorders::kept &&
               options_.topology.virtual_edges != VirtualEdges::on;
    }

    // What can be collapsed in blocks is, and the rest arranged anew. \return false where it was cancelled
    template <class Recorder>
    bool begin_in_blocks(Recorder& recorder) {
        if (!may_be_cut()) return true;
        if (!ground_.original()) return reduce_in_blocks(loop_.target_faces, nullptr, recorder);
        const engine::Original& original = *ground_.original();
        const std::size_t far = engine::TrackedMetric::begins_at * loop_.target_faces;
        const detail::BlockTracking borders{original, ground_.into(), detail::Watched::borders};
        if (!reduce_in_blocks(far, original.open_edges().empty() ? nullptr : &borders, recorder))
            return false;
        const detail::BlockTracking all{original, ground_.into()};
        return reduce_in_blocks(loop_.target_faces, &all, recorder);
    }

    template <class Recorder>
    bool reduce_in_blocks(std::size_t least, const detail::BlockTracking* tracking, Recorder& recorder) {
        const std::size_t faces = ground_.now().triangles.size();
        if (faces <= least) return true;
        engine::LoopOptions loop = loop_;
        const double share = (1 - done_in_blocks_) * static_cast<double>(faces - least) /
                             static_cast<double>(faces - loop.target_faces);
        if (options_.progress) {
            loop.progress = [&](double done) { return progress(done_in_blocks_ + share * done); };
        }
        // What has been cut once may be cut smaller: watching distances is worth more than the waiting costs.
        const std::size_t few =
            is_cut_ ? detail::most_vertices_per_block / 4 : detail::most_vertices_per_block;
        const detail::Arranged& now = ground_.now();
        const detail::BlockInput input{now.positions, now.triangles, ground_.locked(),
                                       detail::vertices_per_block(now.positions.size(), few)};
        const detail::BlockSteps blocks =
            detail::simplify_in_blocks(input, loop, least, tracking, options_.history, workers());
        if (blocks.is_cancelled) return false;
        if (blocks.steps.empty()) return true;
        is_cut_ = true;
        done_in_blocks_ += share;
        counted_.collapses += blocks.steps.size();
        for (std::size_t i = 0; i < refusal_kinds; ++i) counted_.refusals[i] += blocks.refusals[i];
        for (std::size_t i = 0; i < rung_kinds; ++i) counted_.rungs[i] += blocks.rungs[i];
        detail::Reduced reduced = detail::reduce(input, blocks.steps, poll_);
        if constexpr (std::is_same_v<Recorder, engine::HistoryRecorder>) record(blocks, reduced, recorder);
        ground_.take(std::move(reduced));
        return true;
    }

    // Makes room for what is left to do, too: to grow takes twice the memory.
    void record(const detail::BlockSteps& blocks, const detail::Reduced& reduced,
                engine::HistoryRecorder& recorder) const {
        const double faces_to_go = static_cast<double>(ground_.now().triangles.size() - loop_.target_faces);
        const double wanted = std::max(faces_to_go / 2, static_cast<double>(blocks.steps.size()));
        const double share = 1.05 * wanted / static_cast<double>(blocks.steps.size());
        recorder.reserve(static_cast<std::size_t>(share * static_cast<double>(blocks.steps.size())),
                         static_cast<std::size_t>(share * static_cast<double>(blocks.patch_faces.size())));
        for (std::size_t i = 0; i < blocks.steps.size(); ++i) {
            const auto& [survivor, gone, to] = blocks.steps[i];
            const std::size_t begin = blocks.patch_begin[i];
            const std::size_t end =
                i + 1 < blocks.steps.size() ? blocks.patch_begin[i + 1] : blocks.patch_faces.size();
            recorder.collapsed(survivor, gone, to, std::span(blocks.patch_faces).subspan(begin, end - begin));
        }
        recorder.renumber(reduced.vertices, reduced.faces);
    }

    template <class Recorder, class GoesOn>
    engine::LoopResult collapse(Work& work, Recorder& recorder, GoesOn&& goes_on) {
        const Complex& complex = work.complex;
        std::vector<std::pair<Index, Index>> extra;
        if (options_.topology.virtual_edges == VirtualEdges::on) {
            extra = detail::virtual_edges(complex, ground_.now().per_face(mesh_.face_groups),
                                          options_.topology.virtual_edge_distance * settings_.diagonal,
                                          least_length(), poll_);
        }
        counted_.virtual_edges = extra.size();
        engine::PairTable pairs(complex, extra, poll_);
        if (mesh_.attributes) {
            const auto [values, width] = *mesh_.attributes;
            work.wedges = engine::Wedges(
                complex, {ground_.now().per_face<float>(values, std::size_t{3} * width), width}, poll_);
        }
        work.locked = ground_.locked();
        if (options_.topology.group_borders == GroupBorders::kept) {
            work.groups = ground_.now().per_face(mesh_.face_groups);
            work.curves = engine::GroupCurves(complex, work.groups, poll_);
        }
        work.importance = importance(mesh_, prepared_, ground_.now());
        return run(work, pairs, settings_, recorder, loop_, ground_, goes_on);
    }

    // What may be cut carries nothing that an engine could not begin with: each target has one of its own,
    // which knows from the start what a distance costs. Else one engine does it all.
    template <class Recorder>
    void collapse_to_targets(Recorder& recorder) {
        while (results_.size() < targets_.size()) {
            aim();
            const bool is_cancelled = !begin_in_blocks(recorder);
            Work work(ground_.now(), poll_);
            detail::TracingRecorder<Recorder> tracing(recorder, work.complex.vertex_slots());
            engine::LoopResult looped;
            if (is_cancelled) {
                looped.stop = StopReason::cancelled;
                collect(work, tracing.trace(), recorder, looped);
            } else {
                looped = collapse(work, tracing, [&](const engine::LoopResult& so_far) {
                    collect(work, tracing.trace(), recorder, so_far);
                    if (may_be_cut() || is_done()) return false;
                    aim();
                    return true;
                });
            }
            if (is_done()) return;
            detail::count(looped, counted_);
            detail::Reduced left = detail::reduced(work.complex, tracing.trace(), poll_);
            if constexpr (std::is_same_v<Recorder, engine::HistoryRecorder>)
                recorder.renumber(left.vertices, left.faces);
            ground_.take(std::move(left));
        }
    }

    bool is_done() const {
        return results_.size() == targets_.size() || results_.back().report.stop == StopReason::cancelled;
    }

    // The result of a target that was reached, or was not.
    template <class Recorder>
    void collect(const Work& work, const detail::SlotTrace& trace, Recorder& recorder,
                 const engine::LoopResult& looped) {
        SimplifyResult result;
        result.report = counted_;
        detail::count(looped, result.report);
        result.report.stop = looped.stop;
        const bool is_cancelled = looped.stop == StopReason::cancelled;
        const Poll poll = is_cancelled ? Poll() : poll_;  // who has cancelled is not asked again
        const std::vector<Index> slots =
            detail::collect(mesh_, prepared_, ground_.now(), work.complex, work.wedges,
                            ground_.places_of(trace.places()), poll, result);
        if constexpr (std::is_same_v<Recorder, engine::HistoryRecorder>) {
            const bool is_last = results_.size() + 1 == targets_.size();
            result.history = is_last ? recorder.take() : recorder.so_far();
            for (const Index slot : slots) result.history.kept_versions.push_back(recorder.version(slot));
            detail::to_model_units(prepared_, poll, result.history.collapses);
            // The last one may have what nobody needs any more.
            detail::finish_history(mesh_, prepared_.pruned,
                                   is_last ? std::move(prepared_.positions) : prepared_.positions,
                                   is_last ? std::move(prepared_.triangles) : prepared_.triangles, result);
        }
        // Without a collapse the mesh is its own best fit.
        if (settings_.relax && !is_cancelled && result.report.collapses > 0) relax(work, slots, result);
        detail::finish_report(options_, settings_, prepared_, result);
        result.report.seconds.simplify = result.report.seconds.total = watch_.seconds();
        watch_ = {};
        counted_.seconds = {};
        results_.push_back(std::move(result));
    }

    // On vertices of the result, in its order: what no face uses has no say.
    void relax(const Work& work, const std::vector<Index>& slots, SimplifyResult& result) const {
        std::vector<Vector3> now;
        std::vector<std::uint8_t> fixed;
        for (const Index v : slots) {
            now.push_back(work.complex.position(v));
            const bool is_seam = !work.wedges.empty() && work.wedges.is_seam(work.complex, v);
            fixed.push_back(work.locked[v] || is_seam || work.curves.has(v));
        }
        TriangleMesh& mesh = result.mesh;
        std::vector<Vec3> moved = mesh.positions;
        std::vector<Triangle> triangles = mesh.triangles;
        const detail::Patchwork light{now, mesh.triangles};
        detail::Relaxed relaxed;
        if (work.wedges.empty()) {
            relaxed = detail::relax_and_swap(ground_.whole(), light, fixed, mesh.face_groups,
                                             settings_.least_turn, workers());
        } else {  // a swap would have to say what the corners' attributes are
            relaxed.positions = detail::relax(ground_.whole(), light, fixed, settings_.least_turn, workers());
        }
        for (std::size_t v = 0; v < now.size(); ++v) {
            if (relaxed.positions[v] == now[v]) continue;
            moved[v] = prepared_.to_model(relaxed.positions[v]);
        }
        for (const auto& [s, t] : relaxed.swaps) detail::swap_edge(triangles[s], triangles[t]);
        if (!detail::keep_area(mesh.positions, triangles, moved)) return;
        for (std::size_t v = 0; v < now.size(); ++v)
            result.report.vertices_relaxed += moved[v] != mesh.positions[v];
        mesh.positions = std::move(moved);
        mesh.triangles = std::move(triangles);
        result.report.edges_swapped = relaxed.swaps.size();
        if (!result.history.empty()) detail::add_relaxed(relaxed.swaps, result);
    }

    const MeshView& mesh_;
    const Options& options_;
    Phase phase_ = Phase::weld;
    double share_ = 0;  // of the phase, when it was told last
    engine::Asker asker_{[this] { return options_.progress(phase_, share_); }};
    Poll poll_;  // never asks where nobody wants to know
    detail::Settings settings_;
    detail::Prepared prepared_;
    detail::Ground ground_;
    engine::LoopOptions loop_;
    double area_ = 0;  // of the original
    std::span<const std::uint64_t> targets_;
    bool is_cut_ = false;
    double done_in_blocks_ = 0;  // share of the work for the target
    detail::Stopwatch watch_;    // since the last target
    Report counted_;             // by the engines that are through
    std::vector<SimplifyResult> results_;
};

}  // namespace detail

FAQEM_INLINE SimplifyResult simplify(const MeshView& mesh, const Options& options) {
    validate(options);
    if (options.max_error) return detail::simplify_within(mesh, options);
    const std::uint64_t target =
        detail::faces_wanted(options.target, static_cast<double>(mesh.triangles.size()));
    return std::move(detail::run_to(mesh, {&target, 1}, options).front());
}

FAQEM_INLINE std::vector<SimplifyResult> detail::run_to(const MeshView& mesh, std::span<const std::uint64_t> targets,
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
