#include "faqem/simplify.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <span>
#include <string>
#include <type_traits>
#include <utility>

#include "arrange.hpp"
#include "blocks.hpp"
#include "cost_curve.hpp"
#include "faqem/engine/engine.hpp"
#include "faqem/engine/group_curves.hpp"
#include "faqem/engine/importance.hpp"
#include "faqem/engine/memoryless.hpp"
#include "faqem/engine/open_edges.hpp"
#include "faqem/engine/tracked.hpp"
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

std::vector<std::uint8_t> locks(const MeshView& mesh, const detail::Prepared& prepared,
                                const detail::Arranged& arranged, Border border) {
    const std::vector<std::uint8_t> at_vertex =
        detail::locks_of_welded(mesh, prepared.welded, prepared.positions.size());
    std::vector<std::uint8_t> locked;
    for (const Index v : arranged.vertex) locked.push_back(at_vertex[v]);
    if (border == Border::locked) {
        for (const auto& [a, b] : engine::find_open_edges(arranged.triangles, arranged.positions.size()))
            locked[a] = locked[b] = 1;
    }
    return locked;
}

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
    /// Whose place slot v has now, or no_index.
    Index place(Index v) const { return place_[v]; }

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
                       Recorder& recorder, const engine::LoopOptions& loop, const engine::Original* original,
                       std::span<const Index> into) {
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
    return weighted(engine::TrackedMetric({}, *original, engine::Lineage(into), loop.target_faces,
                                          loop.distance_weight, curves),
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
            engine::HistoryRecorder history(arranged_.vertex, arranged_.face,
                                            static_cast<Index>(prepared_.positions.size()));
            collapse_and_collect(history);
            finish_history(history);
        } else {
            engine::NoRecorder nothing;
            collapse_and_collect(nothing);
        }
        take_relaxed();
        finish_report();
        result_.report.seconds.simplify = result_.report.seconds.total = all.seconds();
        return std::move(result_);
    }

    detail::CostCurve curve() {
        prepared_ = detail::prepare(mesh_, settings_);
        arrange();
        Work work(arranged_);
        CostRecorder recorder;
        const engine::LoopResult looped = collapse(work, recorder);
        return {recorder.take(), work.complex.face_count(), settings_.diagonal / prepared_.scale,
                looped.stop != StopReason::cancelled};
    }

private:
    void arrange() {
        arranged_ = detail::arrange(prepared_);
        places_ = arranged_.vertex;
        into_.resize(arranged_.positions.size());
        std::iota(into_.begin(), into_.end(), Index{0});
        locked_ = locks(mesh_, prepared_, arranged_, options_.topology.border);
        if (settings_.carry == detail::Settings::Carry::tracked)
            original_.emplace(arranged_.positions, arranged_.triangles);
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
            loop.distance_weight = area() / static_cast<double>(loop.target_faces);
        loop.tiny_component = 0.02 * settings_.diagonal;
        if (options_.progress) {
            loop.progress = [this](double done) {
                return options_.progress(Phase::simplify, done_in_blocks_ + (1 - done_in_blocks_) * done);
            };
        }
        return loop;
    }

    double least_length() const { return 1e-8 * settings_.diagonal; }

    double area() const {
        double sum = 0;
        for (const Triangle& t : arranged_.triangles) {
            const auto at = [&](std::size_t k) -> const Vector3& { return arranged_.positions[t[k]]; };
            sum += 0.5 * engine::area_vector(at(0), at(1), at(2)).norm();
        }
        return sum;
    }

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
        if (!original_) return reduce_in_blocks(loop_.target_faces, nullptr, recorder);
        if (!reduce_in_blocks(engine::TrackedMetric::begins_at * loop_.target_faces, nullptr, recorder))
            return false;
        const detail::BlockTracking tracking{*original_, into_, loop_.distance_weight};
        return reduce_in_blocks(loop_.target_faces, &tracking, recorder);
    }

    template <class Recorder>
    bool reduce_in_blocks(std::size_t least, const detail::BlockTracking* tracking, Recorder& recorder) {
        const std::size_t faces = arranged_.triangles.size();
        if (faces <= least) return true;
        engine::LoopOptions loop = loop_;
        const double share = (1 - done_in_blocks_) * static_cast<double>(faces - least) /
                             static_cast<double>(faces - loop.target_faces);
        if (options_.progress) {
            loop.progress = [&](double done) {
                return options_.progress(Phase::simplify, done_in_blocks_ + share * done);
            };
        }
        const detail::BlockInput input{arranged_.positions, arranged_.triangles, locked_};
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
        take(std::move(reduced));
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

    void take(detail::Reduced&& reduced) {
        const auto taken = [](const std::vector<Index>& of, const std::vector<Index>& slots) {
            std::vector<Index> result;
            for (const Index slot : slots) result.push_back(slot == no_index ? no_index : of[slot]);
            return result;
        };
        places_ = taken(places_, reduced.places);
        into_ = taken(reduced.into, into_);
        std::vector<std::uint8_t> locked;
        for (const Index v : reduced.vertices) locked.push_back(locked_[v]);
        locked_ = std::move(locked);
        detail::Arranged less{taken(arranged_.vertex, reduced.vertices), taken(arranged_.face, reduced.faces),
                              std::move(reduced.positions), std::move(reduced.triangles)};
        std::swap(arranged_, less);
        if (whole_.positions.empty()) whole_ = std::move(less);
    }

    // Of the original.
    detail::Patchwork whole() const {
        const detail::Arranged& whole = whole_.positions.empty() ? arranged_ : whole_;
        return {whole.positions, whole.triangles};
    }

    template <class Recorder>
    engine::LoopResult collapse(Work& work, Recorder& recorder) {
        const Complex& complex = work.complex;
        std::vector<std::pair<Index, Index>> extra;
        if (options_.topology.virtual_edges == VirtualEdges::on) {
            extra = detail::virtual_edges(complex, arranged_.per_face(mesh_.face_groups),
                                          options_.topology.virtual_edge_distance * settings_.diagonal,
                                          least_length());
        }
        result_.report.virtual_edges = extra.size();
        engine::PairTable pairs(complex, extra);
        if (mesh_.attributes) {
            const auto [values, width] = *mesh_.attributes;
            work.wedges = engine::Wedges(complex, {arranged_.per_face<float>(values, 3 * width), width});
        }
        work.locked = locked_;
        if (options_.topology.group_borders == GroupBorders::kept) {
            work.groups = arranged_.per_face(mesh_.face_groups);
            work.curves = engine::GroupCurves(complex, work.groups);
        }
        work.importance = importance(mesh_, prepared_, arranged_);
        return run(work, pairs, settings_, recorder, loop_, original_ ? &*original_ : nullptr, into_);
    }

    template <class Recorder>
    void collapse_and_collect(Recorder& recorder) {
        const bool goes_on = begin_in_blocks(recorder);
        Work work(arranged_);
        OriginRecorder<Recorder> origin(recorder, std::move(places_));
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
        collect(work.complex, work.wedges, origin);
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
        const std::vector<Vector3> relaxed = detail::relax(whole(), {now, result_.mesh.triangles}, fixed,
                                                           settings_.least_turn, options_.threads);
        for (std::size_t v = 0; v < now.size(); ++v) {
            if (relaxed[v] != now[v]) relaxed_.emplace_back(v, prepared_.to_model(relaxed[v]));
        }
    }

    void take_relaxed() {
        for (const auto& [vertex, position] : relaxed_) result_.mesh.positions[vertex] = position;
        if (!relaxed_.empty() && !result_.history.empty())
            result_.history.kept_positions = result_.mesh.positions;
        result_.report.vertices_relaxed = relaxed_.size();
    }

    // Faces and vertices in input order; what has no area is left out.
    template <class Origin>
    void collect(const Complex& complex, const engine::Wedges& wedges, const Origin& origin) {
        std::vector<Vec3> position(complex.vertex_slots());
        for (Index v = 0; v < position.size(); ++v) {
            const Index at = origin.place(v);
            position[v] = at != no_index ? prepared_.positions[at] : prepared_.to_model(complex.position(v));
        }
        std::vector<Index> slot_of_face(mesh_.triangles.size(), no_index);
        std::vector<Index> slot_of_vertex(prepared_.positions.size(), no_index);
        for (Index f = 0; f < complex.face_slots(); ++f) {
            if (!complex.alive(f)) continue;
            const Triangle& t = complex.triangle(f);
            if (detail::has_no_area(position[t[0]], position[t[1]], position[t[2]])) {
                ++result_.report.faces_dropped;
                continue;
            }
            for (const Index v : t) slot_of_vertex[arranged_.vertex[v]] = v;
            slot_of_face[arranged_.face[f]] = f;
        }
        TriangleMesh& out = result_.mesh;
        std::vector<Index> vertex(complex.vertex_slots(), no_index);
        for (Index v = 0; v < slot_of_vertex.size(); ++v) {
            const Index slot = slot_of_vertex[v];
            if (slot == no_index) continue;
            vertex[slot] = static_cast<Index>(out.positions.size());
            out.positions.push_back(position[slot]);
            result_.vertex_origin.push_back(prepared_.vertex_origin[v]);
            slots_.push_back(slot);
        }
        for (Index f = 0; f < slot_of_face.size(); ++f) {
            const Index slot = slot_of_face[f];
            if (slot == no_index) continue;
            const Triangle& t = complex.triangle(slot);
            result_.face_origin.push_back(f);
            out.triangles.push_back({vertex[t[0]], vertex[t[1]], vertex[t[2]]});
            if (!mesh_.face_groups.empty()) out.face_groups.push_back(mesh_.face_groups[f]);
            for (unsigned corner = 0; corner < 3 && !wedges.empty(); ++corner) {
                const float* values = wedges.values(slot, corner);
                out.attributes.values.insert(out.attributes.values.end(), values, values + wedges.width());
            }
        }
        out.attributes.width = wedges.width();
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
        // The history and the mesh say the same, to the last bit.
        for (std::size_t i = 0; i < history.kept_versions.size(); ++i) {
            const Index v = history.kept_versions[i];
            if (v >= history.positions.size()) {
                history.collapses[v - history.positions.size()].position = result_.mesh.positions[i];
            }
        }
        result_.history = std::move(history);
    }

    void finish_report() {
        Report& report = result_.report;
        const Weights& w = options_.weights;
        if (settings_.carry != detail::Settings::Carry::memory &&
            (w.area || w.boundary || w.normal || w.uv || w.plane_area)) {
            report.warnings.push_back("the weights are those of qem, paper and stmw: preset " +
                                      std::string(name(options_.preset)) + " has none of their terms");
        }
        report.faces_out = result_.mesh.triangles.size();
        report.vertices_out = result_.mesh.positions.size();
        if (report.faces_dropped > 0) {
            report.warnings.push_back(std::to_string(report.faces_dropped) +
                                      " faces without area, or doubles of another face, were dropped");
        }
        report.components_pruned = prepared_.pruned.components;
        report.faces_pruned = prepared_.pruned.faces.size();
        if (report.components_pruned > 0) {
            report.warnings.push_back(std::to_string(report.components_pruned) +
                                      " components smaller than asked for were pruned, with " +
                                      std::to_string(report.faces_pruned) + " faces");
        }
        if (report.components_deleted > 0) {
            report.warnings.push_back(std::to_string(report.components_deleted) +
                                      " small components were deleted to reach the target");
        }
    }

    const MeshView& mesh_;
    const Options& options_;
    detail::Settings settings_;
    detail::Prepared prepared_;
    detail::Arranged arranged_;  // what the engine begins with
    detail::Arranged whole_;     // the original, where it begins with less
    std::optional<engine::Original> original_;
    std::vector<Index> into_;  // the slot that each vertex of the original has gone into, or no_index
    std::vector<std::uint8_t> locked_;  // one per slot
    std::vector<Index> places_;         // whose place each slot has, among the vertices of the prepared mesh
    engine::LoopOptions loop_;
    double done_in_blocks_ = 0;  // share of the work
    SimplifyResult result_;
    std::vector<Index> slots_;                           // slot of each vertex of the result
    std::vector<std::pair<std::size_t, Vec3>> relaxed_;  // vertices of the result, and where they go
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
