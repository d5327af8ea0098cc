#include "faqem/simplify.hpp"

#include <algorithm>
#include <limits>
#include <span>
#include <type_traits>
#include <utility>

#include "collect.hpp"
#include "cost_curve.hpp"
#include "edge_swap.hpp"
#include "faqem/engine/engine.hpp"
#include "faqem/engine/group_curves.hpp"
#include "faqem/engine/importance.hpp"
#include "faqem/engine/memoryless.hpp"
#include "faqem/engine/tracked.hpp"
#include "ground.hpp"
#include "prepare.hpp"
#include "presets.hpp"
#include "relax.hpp"
#include "stopwatch.hpp"
#include "target.hpp"
#include "virtual_edges.hpp"
#include "within_error.hpp"

namespace faqem {

namespace {

using detail::Stopwatch;
using engine::Complex;
using engine::Vector3;

// What the engine works on, in slots.
struct Work {
    explicit Work(const detail::Arranged& arranged) : complex(arranged.positions, arranged.triangles) {}
    Work(const Work&) = delete;

    Complex complex;
    engine::Wedges wedges;
    std::vector<std::uint8_t> locked;
    std::vector<Index> groups;  // borrowed by the curves
    engine::GroupCurves curves;
    std::vector<double> importance;  // empty: the same everywhere
};

// Of vertices at one place the largest weight counts.
std::vector<double> importance(const MeshView& mesh, const detail::Prepared& prepared,
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

// Remembers whose place a slot still has, so that what did not move comes out to the last bit.
template <class Recorder>
class OriginRecorder {
public:
    /// \param places  whose place each slot has, or no_index
    OriginRecorder(Recorder& inner, std::vector<Index> places) : inner_(inner), place_(std::move(places)) {}
    void collapsing(const Complex& complex, Index survivor, Index gone, const engine::Candidate& to) {
        inner_.collapsing(complex, survivor, gone, to);
        if (to.point == complex.position(survivor)) return;
        place_[survivor] = to.point == complex.position(gone) ? place_[gone] : no_index;
    }
    void deleting(Index face) { inner_.deleting(face); }
    /// Whose place each slot has now, or no_index.
    const std::vector<Index>& places() const { return place_; }

private:
    Recorder& inner_;
    std::vector<Index> place_;
};

// Records what every collapse cost.
class CostRecorder {
public:
    void collapsing(const Complex& complex, Index, Index, const engine::Candidate& to) {
        cost_ = std::max(cost_, to.cost);
        steps_.push_back({complex.face_count(), cost_});
    }
    // What takes whole components is the last resort.
    void deleting(Index) { cost_ = std::numeric_limits<double>::infinity(); }
    std::vector<detail::CostCurve::Step> take() { return std::move(steps_); }

private:
    std::vector<detail::CostCurve::Step> steps_;
    double cost_ = 0;
};

template <class Recorder>
engine::LoopResult run(Work& work, engine::PairTable& pairs, const detail::Settings& settings,
                       Recorder& recorder, const engine::LoopOptions& loop, const detail::Ground& ground) {
    engine::GroupCurves* curves = work.curves.empty() ? nullptr : &work.curves;
    const auto collapse = [&]<class Queue>(auto metric, Queue) {
        engine::Engine<decltype(metric), Queue, Recorder> engine(work.complex, pairs, work.wedges,
                                                                 work.locked, metric, recorder, curves);
        return engine.run(loop);
    };
    const auto weighted = [&](auto metric, auto queue) {
        if (work.importance.empty()) return collapse(std::move(metric), queue);
        return collapse(engine::ImportanceMetric(std::move(metric), work.importance), queue);
    };
    switch (settings.carry) {
        case detail::Settings::Carry::memory: {
            std::vector<std::uint8_t> seam(work.wedges.empty() ? 0 : work.complex.vertex_slots());
            for (Index v = 0; v < seam.size(); ++v) seam[v] = work.wedges.is_seam(work.complex, v);
            return weighted(engine::MemoryMetric(settings.weights, seam, curves), engine::HeapQueue());
        }
        case detail::Settings::Carry::memoryless:
            return weighted(engine::MemorylessMetric({}, curves), engine::BucketQueue());
        case detail::Settings::Carry::tracked:
            break;
    }
    return weighted(engine::TrackedMetric({}, *ground.original(), engine::Lineage(ground.into()),
                                          loop.target_faces, loop.distance_weight, curves),
                    engine::BucketQueue());
}

// Everything of one run, in the order it is made.
class Run {
public:
    Run(const MeshView& mesh, const Options& options)
        : mesh_(mesh), options_(options), settings_(detail::settings(options)) {}

    SimplifyResult simplify() {
        const Stopwatch all;
        result_.report.preset = options_.preset;
        result_.report.faces_in = mesh_.triangles.size();
        result_.report.vertices_in = mesh_.positions.size();
        prepared_ = detail::prepare(mesh_, settings_);
        result_.report.faces_dropped = prepared_.dropped_faces;
        result_.report.seconds.weld = all.seconds();
        arrange();
        if (options_.history == Recording::on) {
            engine::HistoryRecorder history(ground_.now().vertex, ground_.now().face,
                                            static_cast<Index>(prepared_.positions.size()));
            collapse_and_collect(history);
            finish_history(history);
        } else {
            engine::NoRecorder nothing;
            collapse_and_collect(nothing);
        }
        take_relaxed();
        detail::finish_report(options_, settings_, prepared_, result_);
        result_.report.seconds.simplify = result_.report.seconds.total = all.seconds();
        return std::move(result_);
    }

    detail::CostCurve curve() {
        prepared_ = detail::prepare(mesh_, settings_);
        arrange();
        Work work(ground_.now());
        CostRecorder recorder;
        const engine::LoopResult looped = collapse(work, recorder);
        return {recorder.take(), work.complex.face_count(), settings_.diagonal / prepared_.scale,
                looped.stop != StopReason::cancelled};
    }

private:
    void arrange() {
        ground_ = detail::Ground(prepared_,
                                 detail::locks_of_welded(mesh_, prepared_.welded, prepared_.positions.size()),
                                 options_.topology.border);
        if (settings_.carry == detail::Settings::Carry::tracked) ground_.remember_original();
        loop_ = loop_options();
    }

    engine::LoopOptions loop_options() {
        engine::LoopOptions loop;
        result_.report.target_faces =
            std::max(detail::smallest_target,
                     detail::faces_wanted(options_.target, static_cast<double>(mesh_.triangles.size())));
        loop.target_faces = static_cast<std::size_t>(result_.report.target_faces);
        loop.rules = {settings_.link, settings_.least_turn, least_length(), settings_.least_fold};
        if (settings_.carry != detail::Settings::Carry::memory)
            loop.distance_weight = ground_.area() / static_cast<double>(loop.target_faces);
        loop.tiny_component = 0.02 * settings_.diagonal;
        if (options_.progress) {
            loop.progress = [this](double done) {
                return options_.progress(Phase::simplify, done_in_blocks_ + (1 - done_in_blocks_) * done);
            };
        }
        return loop;
    }

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
        if (!reduce_in_blocks(engine::TrackedMetric::begins_at * loop_.target_faces, nullptr, recorder))
            return false;
        const detail::BlockTracking tracking{*ground_.original(), ground_.into()};
        return reduce_in_blocks(loop_.target_faces, &tracking, recorder);
    }

    template <class Recorder>
    bool reduce_in_blocks(std::size_t least, const detail::BlockTracking* tracking, Recorder& recorder) {
        const std::size_t faces = ground_.now().triangles.size();
        if (faces <= least) return true;
        engine::LoopOptions loop = loop_;
        const double share = (1 - done_in_blocks_) * static_cast<double>(faces - least) /
                             static_cast<double>(faces - loop.target_faces);
        if (options_.progress) {
            loop.progress = [&](double done) {
                return options_.progress(Phase::simplify, done_in_blocks_ + share * done);
            };
        }
        // What has been cut once may be cut smaller: watching distances is worth more than the waiting costs.
        const std::size_t few =
            done_in_blocks_ > 0 ? detail::most_vertices_per_block / 4 : detail::most_vertices_per_block;
        const detail::Arranged& now = ground_.now();
        const detail::BlockInput input{now.positions, now.triangles, ground_.locked(),
                                       detail::vertices_per_block(now.positions.size(), few)};
        const detail::BlockSteps blocks =
            detail::simplify_in_blocks(input, loop, least, tracking, options_.history, options_.threads);
        if (blocks.is_cancelled) return false;
        if (blocks.steps.empty()) return true;
        done_in_blocks_ += share;
        result_.report.collapses += blocks.steps.size();
        for (std::size_t i = 0; i < refusal_kinds; ++i) result_.report.refusals[i] += blocks.refusals[i];
        for (std::size_t i = 0; i < rung_kinds; ++i) result_.report.rungs[i] += blocks.rungs[i];
        detail::Reduced reduced = detail::reduce(input, blocks.steps);
        if constexpr (std::is_same_v<Recorder, engine::HistoryRecorder>) record(blocks, reduced, recorder);
        ground_.take(std::move(reduced));
        return true;
    }

    static void record(const detail::BlockSteps& blocks, const detail::Reduced& reduced,
                       engine::HistoryRecorder& recorder) {
        for (std::size_t i = 0; i < blocks.steps.size(); ++i) {
            const auto& [survivor, gone, to] = blocks.steps[i];
            const std::size_t begin = blocks.patch_begin[i];
            const std::size_t end =
                i + 1 < blocks.steps.size() ? blocks.patch_begin[i + 1] : blocks.patch_faces.size();
            recorder.collapsed(survivor, gone, to, std::span(blocks.patch_faces).subspan(begin, end - begin));
        }
        recorder.renumber(reduced.vertices, reduced.faces);
    }

    template <class Recorder>
    engine::LoopResult collapse(Work& work, Recorder& recorder) {
        const Complex& complex = work.complex;
        std::vector<std::pair<Index, Index>> extra;
        if (options_.topology.virtual_edges == VirtualEdges::on) {
            extra = detail::virtual_edges(complex, ground_.now().per_face(mesh_.face_groups),
                                          options_.topology.virtual_edge_distance * settings_.diagonal,
                                          least_length());
        }
        result_.report.virtual_edges = extra.size();
        engine::PairTable pairs(complex, extra);
        if (mesh_.attributes) {
            const auto [values, width] = *mesh_.attributes;
            work.wedges = engine::Wedges(complex, {ground_.now().per_face<float>(values, 3 * width), width});
        }
        work.locked = ground_.locked();
        if (options_.topology.group_borders == GroupBorders::kept) {
            work.groups = ground_.now().per_face(mesh_.face_groups);
            work.curves = engine::GroupCurves(complex, work.groups);
        }
        work.importance = importance(mesh_, prepared_, ground_.now());
        return run(work, pairs, settings_, recorder, loop_, ground_);
    }

    template <class Recorder>
    void collapse_and_collect(Recorder& recorder) {
        const bool goes_on = begin_in_blocks(recorder);
        Work work(ground_.now());
        OriginRecorder<Recorder> origin(recorder, ground_.places());
        engine::LoopResult looped;
        if (goes_on)
            looped = collapse(work, origin);
        else
            looped.stop = StopReason::cancelled;
        Report& report = result_.report;
        report.stop = looped.stop;
        report.collapses += looped.collapses;
        for (std::size_t i = 0; i < refusal_kinds; ++i) report.refusals[i] += looped.refusals[i];
        for (std::size_t i = 0; i < rung_kinds; ++i) report.rungs[i] += looped.rungs[i];
        report.components_deleted = looped.components_deleted;
        slots_ = detail::collect(mesh_, prepared_, ground_.now(), work.complex, work.wedges, origin.places(),
                                 result_);
        if (settings_.relax) relax(work);
    }

    // On vertices of the result, in its order: what no face uses has no say.
    void relax(const Work& work) {
        std::vector<Vector3> now;
        std::vector<std::uint8_t> fixed;
        for (const Index v : slots_) {
            now.push_back(work.complex.position(v));
            const bool is_seam = !work.wedges.empty() && work.wedges.is_seam(work.complex, v);
            fixed.push_back(work.locked[v] || is_seam || work.curves.has(v));
        }
        TriangleMesh& mesh = result_.mesh;
        const detail::Patchwork light{now, mesh.triangles};
        detail::Relaxed relaxed;
        if (work.wedges.empty()) {
            relaxed = detail::relax_and_swap(ground_.whole(), light, fixed, mesh.face_groups,
                                             settings_.least_turn, options_.threads);
        } else {  // a swap would have to say what the corners' attributes are
            relaxed.positions =
                detail::relax(ground_.whole(), light, fixed, settings_.least_turn, options_.threads);
        }
        for (std::size_t v = 0; v < now.size(); ++v) {
            if (relaxed.positions[v] != now[v])
                relaxed_.emplace_back(v, prepared_.to_model(relaxed.positions[v]));
        }
        for (const auto& [s, t] : relaxed.swaps) detail::swap_edge(mesh.triangles[s], mesh.triangles[t]);
        swaps_ = std::move(relaxed.swaps);
        result_.report.edges_swapped = swaps_.size();
    }

    void take_relaxed() {
        for (const auto& [vertex, position] : relaxed_) result_.mesh.positions[vertex] = position;
        if (!relaxed_.empty() && !result_.history.empty())
            result_.history.kept_positions = result_.mesh.positions;
        result_.report.vertices_relaxed = relaxed_.size();
    }

    void finish_history(engine::HistoryRecorder& recorder) {
        std::vector<Index> kept_versions;
        for (const Index slot : slots_) kept_versions.push_back(recorder.version(slot));
        CollapseHistory history = recorder.take();
        for (Collapse& collapse : history.collapses) {
            collapse.position = prepared_.to_model(engine::to_eigen(collapse.position));
        }
        // What was pruned is deleted before the first collapse.
        for (const detail::PrunedFace& pruned : prepared_.pruned.faces)
            prepared_.triangles[pruned.face] = pruned.corners;
        std::vector<DeletedFace> deleted_faces;
        for (const detail::PrunedFace& pruned : prepared_.pruned.faces)
            deleted_faces.push_back({0, pruned.face});
        history.deleted_faces.insert(history.deleted_faces.begin(), deleted_faces.begin(),
                                     deleted_faces.end());
        history.positions = std::move(prepared_.positions);
        history.triangles = std::move(prepared_.triangles);
        history.face_groups.assign(mesh_.face_groups.begin(), mesh_.face_groups.end());
        history.kept_versions = std::move(kept_versions);
        history.kept_faces = result_.face_origin;
        for (const auto& [s, t] : swaps_) {
            history.patch_faces.insert(history.patch_faces.end(),
                                       {history.kept_faces[s], history.kept_faces[t]});
            history.patch_begin.push_back(history.patch_faces.size());
        }
        // The history and the mesh say the same, to the last bit.
        for (std::size_t i = 0; i < history.kept_versions.size(); ++i) {
            const Index v = history.kept_versions[i];
            if (v >= history.positions.size()) {
                history.collapses[v - history.positions.size()].position = result_.mesh.positions[i];
            }
        }
        result_.history = std::move(history);
    }

    const MeshView& mesh_;
    const Options& options_;
    detail::Settings settings_;
    detail::Prepared prepared_;
    detail::Ground ground_;
    engine::LoopOptions loop_;
    double done_in_blocks_ = 0;  // share of the work
    SimplifyResult result_;
    std::vector<Index> slots_;                           // slot of each vertex of the result
    std::vector<std::pair<std::size_t, Vec3>> relaxed_;  // vertices of the result, and where they go
    std::vector<detail::EdgeSwap> swaps_;                // faces of the result
};

}  // namespace

SimplifyResult simplify(const MeshView& mesh, const Options& options) {
    validate(options);
    if (options.max_error) return detail::simplify_within(mesh, options);
    return Run(mesh, options).simplify();
}

detail::CostCurve detail::cost_curve(const MeshView& mesh, const Options& options) {
    Options cheap = options;
    cheap.preset = Preset::fast;
    cheap.weights = {};
    cheap.target = faces(detail::smallest_target);
    validate(cheap);
    return Run(mesh, cheap).curve();
}

}  // namespace faqem
