#pragma once
/// \file
/// The collapse loop (paper, Algorithm 1):
///
///     evaluate every pair and insert it into the queue
///     while the mesh has more faces than the target:
///         pop the cheapest pair           (queue empty: take the next rung of the starvation ladder)
///         compute the position of the new vertex
///         illegal?  count the reason and drop the pair until its neighbourhood changes; or, if the violated
///                rule depends on the pair's length, requeue the pair at the cost at which the rule is lifted
///         record the collapse, collapse, merge pairs, re-evaluate the pairs around the new vertex

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "faqem/engine/constraints/boundary_loops.hpp"
#include "faqem/engine/constraints/contraction.hpp"
#include "faqem/engine/constraints/feature_curves.hpp"
#include "faqem/engine/constraints/legality.hpp"
#include "faqem/engine/constraints/rule_exceptions.hpp"
#include "faqem/engine/constraints/wedges.hpp"
#include "faqem/engine/ladder.hpp"
#include "faqem/engine/loop_options.hpp"
#include "faqem/engine/loop_progress.hpp"
#include "faqem/engine/mesh/collapse_mesh.hpp"
#include "faqem/engine/mesh/components.hpp"
#include "faqem/engine/mesh/degenerate.hpp"
#include "faqem/engine/mesh/duplicate_faces.hpp"
#include "faqem/engine/mesh/pair_table.hpp"
#include "faqem/engine/metric/collapse_metric.hpp"
#include "faqem/engine/queue/heap_queue.hpp"
#include "faqem/engine/recorder.hpp"
#include "faqem/engine/util/run_context.hpp"
#include "faqem/export.hpp"
#include "faqem/report.hpp"

FAQEM_ENGINE_BEGIN

/// Collapses vertex pairs of one mesh, cheapest first. Call run() once, then continue_to() any number of
/// times. Not thread-safe.
/// \tparam Metric    determines the cost of a collapse and the new position
/// \tparam Queue     determines which pair is collapsed next
/// \tparam Recorder  is notified of each collapse and deletion; NoRecorder has no cost
template <CollapseMetric Metric, CollapseQueue Queue, CollapseRecorder Recorder>
class Engine {
public:
    /// All arguments passed by reference or pointer are borrowed and must outlive the engine.
    /// \param mesh      the mesh to simplify; modified by run() and continue_to() only
    /// \param pairs     vertex pairs of `mesh`; updated with it
    /// \param wedges    corner attributes to preserve, or an empty object; updated with the mesh
    /// \param locked    one entry per vertex slot; vertices with a nonzero one do not move; the survivors inherit it
    /// \param metric    updated with the mesh
    /// \param recorder  notified before each change
    /// \param curves    boundaries between face groups to preserve; updated with the mesh; null: none
    /// \param queue     moved into the engine
    Engine(CollapseMesh& mesh, PairTable& pairs, Wedges& wedges, std::vector<std::uint8_t>& locked,
           Metric& metric, Recorder& recorder, FeatureCurves* curves = nullptr, Queue queue = Queue())
        : mesh_(mesh),
          pairs_(pairs),
          wedges_(wedges),
          locked_(locked),
          metric_(metric),
          recorder_(recorder),
          curves_(curves),
          legality_(mesh),
          queue_(std::move(queue)),
          has_rejected_(mesh.vertex_slots(), 0),
          contraction_(mesh.vertex_slots()),
          exceptions_(pairs.size()) {}

    /// Collapses pairs until the target face count is reached or no legal collapse is left.
    /// \param options  see LoopOptions
    /// \return what was done, and why it ended
    /// \throws whatever `options.progress` throws. The mesh is consistent then, and when stopped
    /// O(n log n) in the number of pairs, for bounded valence and HeapQueue.
    LoopResult run(const LoopOptions& options) {
        rules_ = options.rules;
        contraction_.keep_closed(options.closed);
        if (!curves_ || curves_->empty()) rules_.groups = GroupBoundaries::free;  // there is nothing to keep
        distance_weight_ = options.distance_weight;
        progress_.start(options, mesh_.face_count());
        const auto ask = [this](Phase, double) { return progress_.report(mesh_.face_count()); };
        context_.emplace(1, ask, options.deadline);
        return run_cancellable([&] {
            degenerate_ = DegenerateFaces(mesh_);
            if (distance_weight_ > 0) boundary_loops_.emplace(mesh_, pairs_);
            context_->check_now();
            queue_.reserve(pairs_.size());
            metric_.initialise(mesh_, pairs_);
            evaluate_all_pairs();
            face_count_at_last_pass_ = mesh_.face_count();
            collapse_to_target(options);
        });
    }

    /// Continues after run() to a lower target. Relaxed rules stay relaxed, and the ladder starts again with its first
    /// rung. If the metric does not depend on the target, the stop does not change the order of the collapses.
    /// \param options  those of run(), with a lower target face count and a distance weight that is not smaller
    /// \return the totals of all calls
    /// \throws whatever `options.progress` throws
    LoopResult continue_to(const LoopOptions& options) {
        distance_weight_ = options.distance_weight;
        metric_.set_target(options.target_faces, options.distance_weight);
        rung_ = 0;
        progress_.start(options, mesh_.face_count());
        result_.stop = StopReason::reached_target;
        return run_cancellable([&] {
            context_->check_now();  // costs are incomplete if the time was over before
            collapse_to_target(options);
        });
    }

private:
    template <class Work>
    LoopResult run_cancellable(Work&& work) {
        try {
            work();
        } catch (const Cancelled& stopped) {
            if (stopped.reason == StopReason::cancelled || mesh_.face_count() > progress_.target_faces())
                result_.stop = stopped.reason;
        }
        return result_;
    }

    void collapse_to_target(const LoopOptions& options) {
        while (!process_queue(options)) {
            if (options.ladder == Ladder::off || !retry_or_relax(options)) {
                result_.stop = StopReason::no_legal_collapse;
                break;
            }
            evaluate_all_pairs();
            face_count_at_last_pass_ = mesh_.face_count();
        }
    }

    // Returns true if all pairs are to be evaluated again, possibly after taking a rung of the ladder.
    bool retry_or_relax(const LoopOptions& options) {
        const std::size_t removed_faces = face_count_at_last_pass_ - mesh_.face_count();
        const std::size_t excess = mesh_.face_count() - options.target_faces;
        // This is expensive. It is repeated only if the faces removed since are a tenth of those in excess.
        const bool worth_it = 10 * removed_faces >= excess && removed_faces > 0;
        if (!worth_it && (rung_ > 0 || result_.rungs[0] > 0))
            return options.ladder == Ladder::on && take_next_rung(options);
        ++result_.rungs[static_cast<std::size_t>(Rung::reseed)];
        defers_high_valence_ = false;
        return true;
    }

    void evaluate_all_pairs() {
        std::fill(has_rejected_.begin(), has_rejected_.end(), std::uint8_t{0});
        for (Index pair = 0; pair < pairs_.size(); ++pair) {
            if (!pairs_.is_alive(pair)) continue;
            context_->count(operations(pair));
            evaluate(pair);
        }
    }

    // Collapses pairs. Returns true once the target is reached, false if the queue becomes empty before.
    bool process_queue(const LoopOptions& options) {
        while (mesh_.face_count() > options.target_faces) {
            if (queue_.empty()) return false;
            const Index pair = queue_.pop();
            context_->count(8 * operations(pair));  // with its tests, and evaluations around it
            if (!try_collapse(pair)) mark_rejected(pair);
        }
        return true;
    }

    void count_refusal(Refusal reason) { ++result_.refusals[static_cast<std::size_t>(reason)]; }

    AllowedPosition allowed_position(Index u, Index v) {
        const AllowedPosition lock = allowed_by_fixed(locked_[u] != 0, locked_[v] != 0);
        if (lock == AllowedPosition::anywhere && !curves_ && wedges_.empty()) return lock;
        if (lock == AllowedPosition::nowhere) return count_refusal(Refusal::locked), lock;
        const AllowedPosition seam = intersection(lock, wedges_.allowed_position(mesh_, u, v));
        if (seam == AllowedPosition::nowhere) return count_refusal(Refusal::seam), seam;
        if (!curves_ || rules_.groups == GroupBoundaries::free) return seam;
        const AllowedPosition group = intersection(seam, curves_->allowed_position(mesh_, pairs_, u, v));
        if (group == AllowedPosition::nowhere) count_refusal(Refusal::group);
        return group;
    }

    std::optional<Candidate> candidate(Index pair) {
        const Index u = pairs_.first(pair), v = pairs_.second(pair);
        if (is_short_pair(mesh_, u, v, rules_.min_pair_length))
            return count_refusal(Refusal::zero_length), std::nullopt;
        return metric_.evaluate(mesh_, pairs_, pair, allowed_position(u, v));
    }

    void evaluate(Index pair) {
        exceptions_.clear(pair);
        if (const auto found = is_deferred(pair) ? std::nullopt : candidate(pair)) {
            queue_.set(pair, found->cost);
        } else {
            queue_.erase(pair);
            mark_rejected(pair);
        }
    }

    // Whether the pair has a high-valence vertex and is not collapsed yet: its tests visit all faces of the vertex, again
    // and again. Other collapses reduce the valence; before the ladder all pairs are evaluated without this rule.
    bool is_deferred(Index pair) const {
        return defers_high_valence_ &&
               (mesh_.is_high_valence(pairs_.first(pair)) || mesh_.is_high_valence(pairs_.second(pair)));
    }

    // Marks both vertices of a pair that left the queue, or was requeued at a higher cost: it is evaluated again when
    // the one-ring of one of them changes.
    void mark_rejected(Index pair) {
        has_rejected_[pairs_.first(pair)] = has_rejected_[pairs_.second(pair)] = 1;
    }

    // False: the pair must not be collapsed and has left the queue. True: it was collapsed or requeued.
    bool try_collapse(Index pair) {
        if (is_deferred(pair)) return false;
        Index u = pairs_.first(pair), v = pairs_.second(pair);
        auto found = candidate(pair);
        if (!found) return false;
        found->cost += boundary_cost(pair);
        if (requeue_if_costlier(pair, found->cost)) return true;
        if (exceptions_.rules_for(pair, rules_).link == LinkCondition::off && contraction_.find(mesh_, u, v))
            return try_contraction(pair, found->cost);
        if (degenerate_.are_last_faces(mesh_, pairs_, pair)) return count_refusal(Refusal::last_faces), false;
        if (const auto refusal =
                legality_.check(mesh_, pairs_, u, v, pair, found->point, exceptions_.rules_for(pair, rules_)))
            return refuse(pair, found->cost, *refusal);
        if constexpr (Metric::has_exact_cost) {
            found->cost = metric_.exact_cost(mesh_, pairs_, pair, *found);
            if (!std::isfinite(found->cost)) return false;
            if (requeue_if_costlier(pair, found->cost)) return true;
            if (metric_.exceeds_limit(*found)) return false;
        }
        // A locked vertex survives, or that of higher valence: its long lists are not to be moved again and again.
        const bool swap = locked_[u] != locked_[v] ? locked_[v] != 0 : mesh_.degree(v) > mesh_.degree(u);
        if (swap) std::swap(u, v);
        count_lifted_rules(pair);
        collapse(u, v, pair, *found);
        return true;
    }

    // Contracts contraction_, which begins with the pair, all of it or nothing. Returns as try_collapse().
    bool try_contraction(Index pair, double cost) {
        if (const auto reason = contraction_.refusal(mesh_, degenerate_.max_count(), locked_))
            return count_refusal(*reason), false;
        Index fixed = no_index;
        const auto allowed = [this](Index u, Index v) { return allowed_position(u, v); };
        if (!contraction_.find_fixed_vertex(pairs_, allowed, fixed)) return false;
        Candidate to = contraction_.candidate(mesh_, fixed);
        to.cost = std::max(cost, to.cost * metric_.weight(pairs_.first(pair), pairs_.second(pair)));
        if (requeue_if_costlier(pair, to.cost)) return true;
        if (const auto reason =
                legality_.check(mesh_, contraction_, to.point, exceptions_.rules_for(pair, rules_)))
            return refuse(pair, to.cost, *reason);
        if constexpr (Metric::has_exact_cost) {
            to.cost = metric_.contraction_cost(mesh_, contraction_, to);
            if (!std::isfinite(to.cost)) return false;
            if (requeue_if_costlier(pair, to.cost)) return true;
        }
        count_lifted_rules(pair);
        contraction_.apply(mesh_, pairs_, fixed, [&](Index survivor, Index removed, Index inner) {
            collapse(survivor, removed, inner, to);
        });
        return true;
    }

    // Counts the refusal of a pair. Returns as try_collapse(): true if the rule is lifted at a higher cost.
    bool refuse(Index pair, double cost, Refusal reason) {
        count_refusal(reason);
        if (!RuleExceptions::is_liftable(rules_, reason)) return false;
        lift_rule(pair, cost, reason);
        return true;
    }

    void count_lifted_rules(Index pair) {
        if (exceptions_.lifts_link(pair)) ++result_.rungs[static_cast<std::size_t>(Rung::without_link)];
        if (exceptions_.lifts_fold(pair)) ++result_.rungs[static_cast<std::size_t>(Rung::fold)];
    }

    double boundary_cost(Index pair) {
        if (!boundary_loops_) return 0;
        const Index u = pairs_.first(pair), v = pairs_.second(pair);
        return distance_weight_ * metric_.weight(u, v) *
               boundary_loops_->squared_distance(mesh_, pairs_, u, v, pair);
    }

    // The rule is lifted for this pair: it is collapsed once all other collapses cost more.
    void lift_rule(Index pair, double cost, Refusal refusal) {
        const Index u = pairs_.first(pair), v = pairs_.second(pair);
        const double square = (mesh_.position(u) - mesh_.position(v)).squaredNorm();
        const double lifted_cost = exceptions_.lift(pair, refusal, square, distance_weight_);
        queue_.set(pair, std::max(cost, lifted_cost * metric_.weight(u, v)));
        mark_rejected(pair);
    }

    // If the queue has a pair to pop before one of this cost, requeues this pair at it and returns true.
    bool requeue_if_costlier(Index pair, double cost) {
        if (!queue_.has_cheaper(cost)) return false;
        queue_.set(pair, cost);
        return true;
    }

    void collapse(Index survivor, Index removed, Index pair, const Candidate& to) {
        const Vector3& p = to.point;
        recorder_.before_collapse(mesh_, survivor, removed, to);
        metric_.before_collapse(mesh_, pairs_, survivor, removed, p);
        wedges_.before_collapse(mesh_, survivor, removed, p);
        degenerate_.before_collapse(mesh_, pairs_, pair);
        if (curves_) curves_->before_collapse(survivor, removed);
        if (boundary_loops_) boundary_loops_->before_collapse(pairs_, survivor, removed, pair);
        mesh_.collapse(survivor, removed, p);
        ++result_.collapses;
        result_.components_collapsed += mesh_.degree(survivor) == 0;
        legality_.after_collapse(mesh_, survivor);
        locked_[survivor] |= locked_[removed];
        contraction_.after_collapse(survivor, removed);
        killed_.clear();
        pairs_.merge(mesh_, survivor, removed, killed_, changes_);
        for (const Index killed : killed_) queue_.erase(killed);
        if (boundary_loops_) boundary_loops_->after_collapse(mesh_, pairs_, survivor);
        metric_.after_collapse(mesh_, pairs_, survivor, changes_);
        for (const PairTable::Change& change : changes_)
            if (change.neighbour.pair != no_index) evaluate(change.neighbour.pair);
        for (const PairTable::Change& change : changes_) {
            const Reevaluation reevaluation = metric_.reevaluation(change);
            if (reevaluation == Reevaluation::none) continue;
            if (defers_high_valence_ && mesh_.is_high_valence(change.neighbour.vertex)) continue;
            std::uint8_t& has_rejected = has_rejected_[change.neighbour.vertex];
            if (reevaluation == Reevaluation::deferred && !std::exchange(has_rejected, std::uint8_t{0}))
                continue;
            pairs_.for_each_pair(change.neighbour.vertex, [&](Neighbour n) {
                if (n.vertex == survivor) return;
                const bool was_refused = exceptions_.any(n.pair) || !queue_.contains(n.pair);
                if (reevaluation == Reevaluation::immediate || was_refused) evaluate(n.pair);
            });
        }
    }

    // Takes the next rung of the ladder. Returns false if none is left.
    bool take_next_rung(const LoopOptions& options) {
        if (delete_duplicate_faces(options)) {
            ++result_.rungs[static_cast<std::size_t>(Rung::duplicate_faces)];
            return true;
        }
        while (++rung_ < rung_kinds) {
            const auto rung = static_cast<Rung>(rung_);
            if (!apply_rung(rung, options)) continue;
            ++result_.rungs[rung_];
            return true;
        }
        return false;
    }

    // Returns false if the rung would change nothing.
    bool apply_rung(Rung rung, const LoopOptions& options) {
        switch (rung) {
            case Rung::tiny_components:
                // A component far smaller than the mesh may be all that is visible, if the mesh has a face far away.
                return delete_components(
                    options, {options.tiny_component_diagonal, visible_area_share * mesh_.area()});
            case Rung::any_component:
                // Seams and groups are treated like locks. Only tiny components are deleted to compensate.
                return wedges_.empty() && !keeps_groups() && delete_components(options, {});
            default:
                return relax_rule(rules_, rung);
        }
    }

    // Deletes duplicate faces until the target is reached. The surface stays the same, but a group might lose its only
    // face: not if groups are preserved.
    bool delete_duplicate_faces(const LoopOptions& options) {
        if (keeps_groups()) return false;
        const bool any = remove_duplicate_faces(mesh_, pairs_, options.target_faces, recorder_);
        if (any && boundary_loops_) boundary_loops_.emplace(mesh_, pairs_);  // new boundary edges
        return any;
    }

    bool keeps_groups() const { return curves_ && rules_.groups == GroupBoundaries::preserved; }

    // Deletes removable components, smallest first, until the target is reached; never the largest one.
    bool delete_components(const LoopOptions& options, const ComponentSize& largest) {
        killed_.clear();
        const std::size_t deleted =
            remove_components(mesh_, pairs_, locked_, largest, options.target_faces, recorder_, killed_);
        for (const Index pair : killed_) queue_.erase(pair);
        result_.components_deleted += deleted;
        return deleted > 0;
    }

    // An estimate for the cancellation check: evaluating a pair visits all faces at both vertices.
    std::uint64_t operations(Index pair) const {
        return 1 + (mesh_.degree(pairs_.first(pair)) + mesh_.degree(pairs_.second(pair))) / 16;
    }

    static constexpr double visible_area_share = 0.02;  // components with a larger one are not tiny

    CollapseMesh& mesh_;
    PairTable& pairs_;
    Wedges& wedges_;
    std::vector<std::uint8_t>& locked_;
    Metric& metric_;
    Recorder& recorder_;
    FeatureCurves* curves_;
    Legality legality_;
    DegenerateFaces degenerate_;
    std::optional<BoundaryLoops> boundary_loops_;
    double distance_weight_ = 0;
    Queue queue_;
    std::vector<std::uint8_t> has_rejected_;  // per vertex: its pairs may have been rejected
    bool defers_high_valence_ = true;         // see is_deferred()
    Contraction contraction_;
    RuleExceptions exceptions_;
    Rules rules_;
    LoopResult result_;
    std::size_t rung_ = 0;
    std::size_t face_count_at_last_pass_ = 0;  // when all pairs were last evaluated
    LoopProgress progress_;
    std::optional<RunContext> context_;  // since run()
    std::vector<Index> killed_;
    std::vector<PairTable::Change> changes_;
};

FAQEM_ENGINE_END
