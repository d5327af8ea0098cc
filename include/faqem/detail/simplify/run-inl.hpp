#pragma once

#include "faqem/detail/simplify/run.hpp"

#include <utility>

#include "faqem/detail/base/stopwatch.hpp"
#include "faqem/detail/geometry/bvh.hpp"
#include "faqem/detail/simplify/budget_by_cost.hpp"
#include "faqem/detail/simplify/build_result.hpp"
#include "faqem/detail/simplify/engine_run.hpp"
#include "faqem/detail/simplify/preprocess.hpp"
#include "faqem/detail/simplify/presets.hpp"
#include "faqem/detail/simplify/result_fitting.hpp"
#include "faqem/detail/simplify/run_recorder.hpp"
#include "faqem/detail/simplify/run_state.hpp"
#include "faqem/detail/simplify/virtual_edges.hpp"

FAQEM_DETAIL_BEGIN

// One run of simplify(): preprocessing, collapses, fitting, results.
class Run {
public:
    Run(const MeshView& mesh, const Options& options, const RunContext& context)
        : mesh_(mesh), options_(options), context_(context), settings_(settings(options)) {
        context_.show(Phase::weld, 0);
        loop_.deadline = context_.deadline();
    }
    Run(const Run&) = delete;

    std::vector<SimplifyResult> simplify(std::span<const std::uint64_t> targets) {
        targets_ = targets;
        try {
            start();
            collapse_to_targets();
        } catch (const engine::Cancelled&) {
            SimplifyResult nothing;
            nothing.report = totals_;
            nothing.report.stop = StopReason::cancelled;
            results_.push_back(std::move(nothing));
        }
        return std::move(results_);
    }

    std::optional<SimplifyResult> simplify_within(double allowed, double untracked_share,
                                                  const FindFarFaces& far) {
        targets_ = {&min_target_faces, 1};
        settings_.quadric_policy = Settings::QuadricPolicy::tracked;
        if (mesh_.triangles.empty() || (untracked_share > 0 && !may_change_engine())) return std::nullopt;
        far_ = &far;
        start();
        loop_.ladder = engine::Ladder::off;
        limit_ = {allowed * prepared_.scale, untracked_share, {}};
        if (untracked_share > 0) {
            set_target();
            EngineInput work(state_.mesh());
            RunRecorder recorder(work.collapse_mesh.vertex_slots(), history_ ? &*history_ : nullptr);
            advance(work, recorder, collapse_once(work, recorder));
        }
        loop_.ladder = engine::Ladder::reseed;
        set_target();
        const MeshRef surface = state_.initial_surface();
        const Bvh tree(surface.positions, surface.triangles, untimed_);
        const double most = engine::DistanceLimit::share_inside * limit_.distance;
        limit_.untracked_share = 0;
        limit_.is_near = [&tree, most](const engine::Vector3& p) { return is_near(tree, p, most); };
        UndoableSteps steps;
        EngineInput work(state_.mesh());
        RunRecorder recorder(work.collapse_mesh.vertex_slots(), nullptr, nullptr, &steps);
        return repaired(steps, collapse_once(work, recorder));
    }

    CostCurve curve() {
        targets_ = {&min_target_faces, 1};
        try {
            prepare();
            set_target();
            EngineInput work(state_.mesh());
            std::vector<CostCurve::Step> steps;
            RunRecorder recorder(work.collapse_mesh.vertex_slots(), nullptr, &steps);
            const StopReason stop = collapse_once(work, recorder).stop;
            return {std::move(steps), work.collapse_mesh.face_count(), settings_.diagonal / prepared_.scale,
                    stop};
        } catch (const engine::Cancelled& stopped) {
            return {{}, 0, 0, stopped.reason};
        }
    }

private:
    void start() {
        totals_.preset = options_.preset;
        totals_.faces_in = mesh_.triangles.size();
        totals_.vertices_in = mesh_.positions.size();
        prepare();
        if (options_.history == Recording::on)
            history_.emplace(state_.mesh().vertex, state_.mesh().face,
                             static_cast<Index>(prepared_.positions.size()));
    }

    // Undoes the last step at each place that is too far, until there is none. \return nothing if there was no step
    std::optional<SimplifyResult> repaired(UndoableSteps& steps, engine::LoopResult done) {
        std::vector<Index> slot_of_face(mesh_.triangles.size(), no_index);
        for (Index f = 0; f < state_.mesh().face.size(); ++f) slot_of_face[state_.mesh().face[f]] = f;
        while (true) {
            SimplifyResult result;
            replay(steps, nullptr, [&](const EngineInput& work, const SlotTrace& trace) {
                build_result(mesh_, prepared_, state_.mesh(), work.collapse_mesh, work.wedges,
                             state_.source_vertices_of(trace.source_slots()), result);
            });
            if (result.mesh.triangles.empty()) return std::nullopt;
            const std::vector<FarFaces> far = (*far_)(result.mesh);
            if (far.empty()) break;
            for (const auto& [face, original] : far) {
                if (!steps.undo_last(slot_of_face[result.face_origin[face]]) &&
                    (original == no_index || !steps.undo_last(slot_of_face[original])))
                    return std::nullopt;
            }
        }
        done.collapses = steps.count();
        if (done.stop == StopReason::no_legal_collapse) done.stop = StopReason::reached_max_error;
        replay(steps, history_ ? &*history_ : nullptr,
               [&](const EngineInput& work, const SlotTrace& trace) { add_result(work, trace, done); });
        return std::move(results_.front());
    }

    // Calls use(work, trace) with the surface after the steps.
    template <class Use>
    void replay(UndoableSteps& steps, engine::HistoryRecorder* history, Use&& use) const {
        EngineInput work(state_.mesh());
        fill(work);
        RunRecorder recorder(work.collapse_mesh.vertex_slots(), history);
        steps.replay(work.collapse_mesh.face_slots(),
                     [&](Index survivor, Index removed, const engine::Vector3& to) {
                         recorder.before_collapse(work.collapse_mesh, survivor, removed, {to, 0});
                         work.wedges.before_collapse(work.collapse_mesh, survivor, removed, to);
                         if (!work.curves.empty()) work.curves.before_collapse(survivor, removed);
                         work.locked[survivor] |= work.locked[removed];
                         work.collapse_mesh.collapse(survivor, removed, to);
                     });
        use(work, recorder.trace());
    }

    void prepare() {
        prepared_ = preprocess(mesh_, settings_, untimed_);
        totals_.faces_dropped = prepared_.dropped_faces;
        totals_.seconds.weld = stopwatch_.seconds();
        state_ = RunState(prepared_, welded_locks(mesh_, prepared_.welded, prepared_.positions.size()),
                          options_.topology.boundary, untimed_);
        if (options_.history == Recording::off) prepared_.release_triangles();
        if (mesh_.vertex_weights.empty()) prepared_.release_welded();
        if (settings_.fit_vertices) state_.keep_initial_surface();
        if (settings_.quadric_policy == Settings::QuadricPolicy::tracked) state_.track_original();
        // Virtual edges are to join borders, which the borders' own rule would not.
        if (settings_.quadric_policy != Settings::QuadricPolicy::memory &&
            options_.topology.virtual_edges != VirtualEdges::on)
            state_.find_planar_borders();
        if (!supports_rounds()) state_.release_links();
        untimed_.check_now();
        area_ = state_.area();
        loop_.rules = {settings_.link, settings_.min_normal_cosine, min_pair_length_,
                       settings_.min_fold_cosine};
        loop_.rules.groups = options_.topology.group_boundaries;
        loop_.tiny_component_diagonal = 0.02 * settings_.diagonal;
        loop_.progress = [this](double done) {
            context_.show(Phase::simplify, progress_at(done_in_rounds_ + (1 - done_in_rounds_) * done));
            return context_.ask();
        };
    }

    void set_target() {
        totals_.target_faces = std::max(min_target_faces, targets_[results_.size()]);
        loop_.target_faces = static_cast<std::size_t>(totals_.target_faces);
        // With a limit nobody knows the face count of the result.
        const std::size_t faces = limit_.is_finite() ? state_.mesh().triangles.size() : loop_.target_faces;
        if (settings_.quadric_policy != Settings::QuadricPolicy::memory)
            loop_.distance_weight = area_ / static_cast<double>(faces);
        done_in_rounds_ = 0;
    }

    // The share of a target is proportional to the number of faces removed for it.
    double progress_at(double done) const {
        const auto gone = [&](std::size_t targets) {
            const double faces = static_cast<double>(mesh_.triangles.size());
            return targets == 0 ? 0 : faces - std::min(faces, static_cast<double>(targets_[targets - 1]));
        };
        const double before = gone(results_.size()), after = gone(results_.size() + 1);
        const double all = gone(targets_.size());
        return all > 0 ? (before + done * (after - before)) / all : done;
    }

    // See LoopOptions::closed. `paper` and `stmw` are as published.
    std::span<const std::uint8_t> closed() const {
        const bool is_published = options_.preset == Preset::paper || options_.preset == Preset::stmw;
        return is_published ? std::span<const std::uint8_t>() : state_.closed();
    }

    // Whether boundaries between groups are more than free.
    bool has_curves() const {
        return options_.topology.group_boundaries != GroupBoundaries::free && !mesh_.face_groups.empty();
    }

    // One per face slot; empty if their boundaries are free.
    std::vector<Index> groups() const {
        return has_curves() ? state_.mesh().per_face(mesh_.face_groups) : std::vector<Index>();
    }

    // Not with attributes, weights or virtual edges.
    bool supports_rounds() const {
        return settings_.quadric_policy != Settings::QuadricPolicy::memory && !mesh_.attributes &&
               mesh_.vertex_weights.empty() && options_.topology.virtual_edges != VirtualEdges::on;
    }

    // Whether engines may follow each other: attributes, preserved groups and weights belong to one.
    bool may_change_engine() const { return supports_rounds() && !has_curves(); }

    void simplify_in_rounds_first() {
        const std::size_t faces = state_.mesh().triangles.size();
        if (!supports_rounds() || faces <= loop_.target_faces || context_.is_late()) return;
        const RunContext step = context_.step(Phase::simplify, progress_at(0), progress_at(share_of_rounds));
        RoundSteps found;
        std::optional<CompactedMesh> left = state_.simplify_in_rounds(
            loop_.target_faces, loop_.distance_weight, groups(), options_.history, step, found);
        if (!left) return;
        done_in_rounds_ = share_of_rounds;
        totals_.collapses += found.collapses;
        for (std::size_t i = 0; i < refusal_kinds; ++i) totals_.refusals[i] += found.refusals[i];
        if (history_) record_steps(found, *left, loop_.target_faces, *history_);
        state_.advance_to(std::move(*left));
    }

    engine::LoopResult collapse(EngineInput& work, RunRecorder& recorder,
                                const std::function<bool(const engine::LoopResult&)>& should_continue) {
        const CollapseMesh& collapse_mesh = work.collapse_mesh;
        std::vector<std::pair<Index, Index>> extra;
        if (options_.topology.virtual_edges == VirtualEdges::on) {
            extra =
                virtual_edges(collapse_mesh, state_.mesh().per_face(mesh_.face_groups),
                              options_.topology.virtual_edge_distance * settings_.diagonal, min_pair_length_);
        }
        totals_.virtual_edges = extra.size();
        engine::PairTable pairs(collapse_mesh, extra);
        fill(work);
        loop_.closed = closed();
        return run_engine(work, pairs, settings_, recorder, loop_, state_, context_, should_continue, limit_);
    }

    engine::LoopResult collapse_once(EngineInput& work, RunRecorder& recorder) {
        const engine::LoopResult result =
            collapse(work, recorder, [](const engine::LoopResult&) { return false; });
        if (result.stop == StopReason::cancelled) throw engine::Cancelled{};
        return result;
    }

    // Sets what belongs to the vertices and faces of the surface.
    void fill(EngineInput& work) const {
        if (mesh_.attributes) {
            const auto [values, width] = *mesh_.attributes;
            work.wedges = engine::Wedges(
                work.collapse_mesh, {state_.mesh().per_face<float>(values, std::size_t{3} * width), width});
        }
        work.locked = state_.locked();
        work.borders = state_.borders().at;
        if (has_curves()) {
            work.groups = groups();
            work.curves = engine::FeatureCurves(work.collapse_mesh, work.groups);
        }
        work.importance = vertex_importance(mesh_, prepared_, state_.mesh());
    }

    // If engines may follow each other, each target has its own, which uses the right distance weight from the start.
    // Otherwise one engine continues from target to target, since its state cannot be transferred.
    void collapse_to_targets() {
        while (results_.size() < targets_.size()) {
            set_target();
            simplify_in_rounds_first();
            state_.release_links();
            EngineInput work(state_.mesh());
            RunRecorder recorder(work.collapse_mesh.vertex_slots(), history_ ? &*history_ : nullptr);
            const auto loop_result = collapse(work, recorder, [&](const engine::LoopResult& so_far) {
                add_result(work, recorder.trace(), so_far);
                if (may_change_engine() || is_done()) return false;
                set_target();
                return true;
            });
            if (is_done()) return;
            advance(work, recorder, loop_result);
        }
    }

    // Replaces the surface by the result of an engine.
    void advance(const EngineInput& work, RunRecorder& recorder, const engine::LoopResult& loop_result) {
        add_counts(loop_result, totals_);
        CompactedMesh left = compacted(work.collapse_mesh, recorder.trace());
        if (history_) history_->renumber(left.vertices, left.faces);
        state_.advance_to(std::move(left));
    }

    bool is_done() const {
        return results_.size() == targets_.size() || results_.back().report.stop == StopReason::cancelled;
    }

    // Adds the result of the current target, whether or not it was reached.
    void add_result(const EngineInput& work, const SlotTrace& trace, const engine::LoopResult& loop_result) {
        SimplifyResult result;
        result.report = totals_;
        add_counts(loop_result, result.report);
        result.report.stop = loop_result.stop;
        const std::vector<Index> slots =
            build_result(mesh_, prepared_, state_.mesh(), work.collapse_mesh, work.wedges,
                         state_.source_vertices_of(trace.source_slots()), result);
        if (history_) {
            const bool is_last = results_.size() + 1 == targets_.size();
            result.history = is_last ? history_->take() : history_->history();
            for (const Index slot : slots)
                result.history.remaining_versions.push_back(history_->version(slot));
            to_model_units(prepared_, result.history.collapses);
            // The arrays are moved into the last result.
            finish_history(mesh_, prepared_.pruned,
                           is_last ? std::move(prepared_.positions) : prepared_.positions,
                           is_last ? std::move(prepared_.triangles) : prepared_.triangles, result);
        }
        if (settings_.fit_vertices) fit(work, slots, result);
        finish_report(options_, settings_, prepared_, result);
        result.report.seconds.simplify = result.report.seconds.total = stopwatch_.seconds();
        stopwatch_ = {};
        totals_.seconds = {};
        results_.push_back(std::move(result));
    }

    // Fits the vertices, unless the run was stopped or the time is over, or without a collapse. Not if the result is too
    // far from the original then.
    void fit(const EngineInput& work, const std::vector<Index>& slots, SimplifyResult& result) {
        Report& report = result.report;
        if (report.stop == StopReason::cancelled || report.stop == StopReason::reached_time_limit) return;
        if (report.collapses == 0) return;
        std::optional<SimplifyResult> unfitted;
        if (far_) unfitted = result;
        const bool is_fitted = context_.in_time([&] {
            fit_result(state_, prepared_, settings_.min_normal_cosine, work, slots, context_, result);
        });
        if (far_ && !(*far_)(result.mesh).empty()) result = std::move(*unfitted);
        if (!is_fitted) report.warnings.push_back("max_seconds was over before the vertices were fitted");
    }

    const MeshView& mesh_;
    const Options& options_;
    const RunContext& context_;
    // The time limit does not stop steps without which there is no result.
    const RunContext untimed_ = context_.untimed();
    Settings settings_;
    const double min_pair_length_ = 1e-8 * settings_.diagonal;
    PreprocessedMesh prepared_;
    RunState state_;
    std::optional<engine::HistoryRecorder> history_;  // if a history is recorded
    engine::LoopOptions loop_;
    double area_ = 0;  // of the original, engine units
    engine::DistanceLimit limit_;
    const FindFarFaces* far_ = nullptr;  // not null: the result must have no such faces
    std::span<const std::uint64_t> targets_;
    static constexpr double share_of_rounds = 0.7;  // of the progress towards a target
    double done_in_rounds_ = 0;                     // share_of_rounds after rounds
    Stopwatch stopwatch_;                           // since the last target
    Report totals_;                                 // sums of rounds and of engines that have finished
    std::vector<SimplifyResult> results_;
};

FAQEM_INLINE std::vector<SimplifyResult> run_to_targets(const MeshView& mesh,
                                                        std::span<const std::uint64_t> targets,
                                                        const Options& options, const RunContext& context) {
    return Run(mesh, options, context).simplify(targets);
}

FAQEM_INLINE std::optional<SimplifyResult> run_within(const MeshView& mesh, double allowed,
                                                      const FindFarFaces& far, const Options& options,
                                                      const RunContext& context) {
    for (const double share : {0.1, 0.03, 0.0}) {
        auto found = Run(mesh, options, context).simplify_within(allowed, share, far);
        if (found) return is_held_by_handles(found->mesh.view()) ? std::nullopt : std::move(found);
    }
    return std::nullopt;
}

FAQEM_INLINE CostCurve cost_curve(const MeshView& mesh, const Options& options, const RunContext& context) {
    Options cheap = options;
    cheap.preset = Preset::fast;
    cheap.weights = {};
    validate(cheap);
    return Run(mesh, cheap, context).curve();
}

FAQEM_DETAIL_END
