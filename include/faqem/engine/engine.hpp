#pragma once
/// \file
/// The collapse loop (paper, Algorithm 1):
///
///     evaluate every pair, put it in the queue
///     while more faces than the target:
///         pop the cheapest pair           (queue empty: climb the starvation ladder)
///         place the new vertex
///         veto?  count the reason, forget the pair until its surroundings change; or, where its size is
///                the reason to keep it, until collapses cost more than that
///         record, collapse, merge pairs
///         evaluate the pairs around the new vertex anew

#include <algorithm>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "faqem/export.hpp"
#include "faqem/engine/constraints/boundary_loops.hpp"
#include "faqem/engine/mesh/triangle_soup.hpp"
#include "faqem/engine/mesh/components.hpp"
#include "faqem/engine/mesh/degenerate.hpp"
#include "faqem/engine/mesh/duplicate_faces.hpp"
#include "faqem/engine/constraints/feature_curves.hpp"
#include "faqem/engine/ladder.hpp"
#include "faqem/engine/constraints/legality.hpp"
#include "faqem/engine/loop.hpp"
#include "faqem/engine/metric/accumulated.hpp"
#include "faqem/engine/mesh/pair_table.hpp"
#include "faqem/engine/queue/heap_queue.hpp"
#include "faqem/engine/recorder.hpp"
#include "faqem/engine/constraints/wedges.hpp"
#include "faqem/report.hpp"

FAQEM_NAMESPACE_BEGIN
namespace engine {

/// Collapses pairs of one complex. run() is called once, go_on() as often as wanted.
/// \tparam Metric    what a collapse costs and where it goes
/// \tparam Queue     which pair is next
/// \tparam Recorder  who is told; NoRecorder costs nothing
template <CollapseMetric Metric, CollapseQueue Queue, CollapseRecorder Recorder>
class Engine {
public:
    /// \param complex   the surface; changed by run()
    /// \param pairs     of the complex
    /// \param wedges    kept attributes, or empty
    /// \param locked    one per vertex slot: nonzero must not move
    /// \param curves    between groups, to be kept; null: none
    /// All are borrowed and must outlive the engine.
    Engine(Complex& complex, PairTable& pairs, Wedges& wedges, std::vector<std::uint8_t>& locked,
           Metric& metric, Recorder& recorder, GroupCurves* curves = nullptr, Queue queue = Queue())
        : complex_(complex),
          pairs_(pairs),
          wedges_(wedges),
          locked_(locked),
          metric_(metric),
          recorder_(recorder),
          curves_(curves),
          legality_(complex),
          queue_(std::move(queue)),
          has_vetoed_(complex.vertex_slots(), 0),
          lifted_(pairs.size(), 0) {}

    /// Runs to the target. O(n log n) in the number of pairs for bounded valence.
    LoopResult run(const LoopOptions& options) {
        rules_ = options.rules;
        distance_weight_ = options.distance_weight;
        first_count_ = complex_.face_count();
        ask_as(options);
        if (options.progress) poll_ = Poll(asker_);
        return unless_cancelled([&] {
            degenerate_ = DegenerateFaces(complex_, poll_);
            if (distance_weight_ > 0) borders_.emplace(complex_, pairs_, options.first_context, poll_);
            queue_.reserve(pairs_.size());
            if constexpr (AimingQueue<Queue>) queue_.aim(pairs_left(options.target_faces), poll_);
            initialise(metric_, complex_, pairs_, poll_);
            seed();
            seeded_at_ = complex_.face_count();
            collapse_to_target(options);
        });
    }

    /// After run(), on to a lower target. Rules stay as far relaxed as they are; what is left of the ladder
    /// is climbed anew. A metric that does not depend on the target goes on as if there had been no stop.
    /// \param options  those of run(), with another target and no smaller distance weight
    /// \return the sums of all calls
    LoopResult go_on(const LoopOptions& options) {
        distance_weight_ = options.distance_weight;
        if constexpr (AimingMetric<Metric>) metric_.aim(options.target_faces, options.distance_weight);
        first_count_ = complex_.face_count();
        rung_ = 0;
        ask_as(options);
        result_.stop = StopReason::reached_target;
        return unless_cancelled([&] { collapse_to_target(options); });
    }

private:
    void ask_as(const LoopOptions& options) {
        progress_ = options.progress;
        target_count_ = options.target_faces;
    }

    template <class Work>
    LoopResult unless_cancelled(Work&& work) {
        try {
            work();
        } catch (const Cancelled&) {
            result_.stop = StopReason::cancelled;
        }
        return result_;
    }

    void collapse_to_target(const LoopOptions& options) {
        while (!drain(options)) {
            if (options.ladder == Ladder::stay || !find_more(options)) {
                result_.stop = StopReason::no_legal_collapse;
                break;
            }
            seed();
            seeded_at_ = complex_.face_count();
        }
    }

    std::size_t pairs_left(std::size_t faces) const {
        const double share =
            static_cast<double>(faces) / static_cast<double>(std::max<std::size_t>(first_count_, 1));
        return static_cast<std::size_t>(share * static_cast<double>(pairs_.size()));
    }

    // Tells whether all pairs are worth another look, after a rung of the ladder perhaps.
    bool find_more(const LoopOptions& options) {
        const std::size_t removed = seeded_at_ - complex_.face_count();
        const std::size_t excess = complex_.face_count() - options.target_faces;
        // Seeding costs a pass over all pairs: again only while it brings the target nearer by a tenth.
        const bool worth_it = 10 * removed >= excess && removed > 0;
        if (!worth_it && (rung_ > 0 || result_.rungs[0] > 0)) return climb(options);
        ++result_.rungs[static_cast<std::size_t>(Rung::reseed)];
        return true;
    }

    void seed() {
        std::fill(has_vetoed_.begin(), has_vetoed_.end(), std::uint8_t{0});
        for (Index pair = 0; pair < pairs_.size(); ++pair) {
            if (pairs_.alive(pair)) evaluate(pair);
        }
    }

    // Collapses until the target is reached (true), or the queue is empty (false).
    bool drain(const LoopOptions& options) {
        while (complex_.face_count() > options.target_faces) {
            if (queue_.empty()) return false;
            poll_(evaluations_per_collapse);
            const Index pair = queue_.pop();
            if (!try_collapse(pair)) veto(pair);
        }
        return true;
    }

    Continue ask() const {
        const double done = static_cast<double>(first_count_ - complex_.face_count());
        const double all = static_cast<double>(first_count_ - std::min(target_count_, first_count_));
        return progress_(all > 0 ? std::min(done / all, 1.0) : 1.0);
    }

    void refuse(Refusal reason) { ++result_.refusals[static_cast<std::size_t>(reason)]; }

    Freedom freedom(Index u, Index v) {
        const bool u_stays = locked_[u], v_stays = locked_[v];
        if (!u_stays && !v_stays && !curves_ && wedges_.empty()) return Freedom::anywhere;
        if (u_stays && v_stays) return refuse(Refusal::locked), Freedom::nowhere;
        const Freedom lock = u_stays ? Freedom::at_first : v_stays ? Freedom::at_second : Freedom::anywhere;
        const Freedom seam = both(lock, wedges_.freedom(complex_, u, v));
        if (seam == Freedom::nowhere) return refuse(Refusal::seam), seam;
        if (!curves_) return seam;
        const Freedom group = both(seam, curves_->freedom(complex_, pairs_, u, v));
        if (group == Freedom::nowhere) refuse(Refusal::group);
        return group;
    }

    std::optional<Candidate> candidate(Index pair) {
        const Index u = pairs_.first(pair), v = pairs_.second(pair);
        const double square = (complex_.position(u) - complex_.position(v)).squaredNorm();
        if (!(square >= rules_.least_length * rules_.least_length))
            return refuse(Refusal::zero_length), std::nullopt;
        return metric_.evaluate(complex_, pairs_, pair, freedom(u, v));
    }

    void evaluate(Index pair) {
        poll_();
        lifted_[pair] = 0;
        if (const auto found = candidate(pair)) {
            queue_.set(pair, found->cost);
        } else {
            queue_.erase(pair);
            veto(pair);
        }
    }

    // Evaluates the pair, now or when its turn comes.
    void renew(Index pair) {
        if constexpr (LazyQueue<Queue>) {
            if (queue_.outdate(pair) && !lifted_[pair]) return;
        }
        evaluate(pair);
    }

    // The pair is out of the queue, or far behind in it, until the surroundings of one of its ends change.
    void veto(Index pair) { has_vetoed_[pairs_.first(pair)] = has_vetoed_[pairs_.second(pair)] = 1; }

    // False: it may not be done. It need not be done yet, either.
    bool try_collapse(Index pair) {
        Index u = pairs_.first(pair), v = pairs_.second(pair);
        auto found = candidate(pair);
        if (!found) return false;
        found->cost += border_cost(pair);
        if (postpone(pair, found->cost)) return true;
        if (degenerate_.are_all_others(complex_, pairs_, pair, poll_))
            return refuse(Refusal::last_faces), false;
        if (const auto refusal = legality_.check(complex_, pairs_, u, v, pair, found->point, rules(pair))) {
            refuse(*refusal);
            const bool may_lift = is_lifted_by_size(*refusal);
            if (may_lift) lift(pair, found->cost, *refusal);
            return may_lift;
        }
        if constexpr (RefiningMetric<Metric>) {
            found->cost = metric_.refine(complex_, pairs_, u, v, *found);
            if (postpone(pair, found->cost)) return true;
        }
        // A locked vertex survives. Else the fuller one does: its lists need not be walked again and again at
        // a hub.
        const bool swap =
            locked_[u] != locked_[v] ? locked_[v] != 0 : complex_.degree(v) > complex_.degree(u);
        if (swap) std::swap(u, v);
        if (lifted_[pair] & link_bit) ++result_.rungs[static_cast<std::size_t>(Rung::without_link)];
        if (lifted_[pair] & fold_bit) ++result_.rungs[static_cast<std::size_t>(Rung::fold)];
        collapse(u, v, pair, *found);
        return true;
    }

    double border_cost(Index pair) {
        if (!borders_) return 0;
        const Index u = pairs_.first(pair), v = pairs_.second(pair);
        return distance_weight_ * weight(u, v) * borders_->squared_distance(complex_, pairs_, u, v, pair);
    }

    double weight(Index u, Index v) const {
        if constexpr (WeighingMetric<Metric>) {
            return metric_.weight(u, v);
        } else {
            return 1;
        }
    }

    Rules rules(Index pair) const {
        Rules rules = rules_;
        if (lifted_[pair] & link_bit) rules.link = LinkCondition::off;
        if (lifted_[pair] & fold_bit) rules.least_fold = -1;
        return rules;
    }

    bool is_lifted_by_size(Refusal refusal) const {
        if (rules_.link == LinkCondition::by_size)
            return refusal == Refusal::link || refusal == Refusal::fold;
        return refusal == Refusal::fold && rules_.link == LinkCondition::off;
    }

    // What the link condition or the rule against folds protects at a pair is about as large as the pair:
    // against it the surface moves by its length, over an area of its length squared; a fold is seen beyond
    // that. Where all other collapses cost more, it is lifted.
    void lift(Index pair, double cost, Refusal refusal) {
        const Index u = pairs_.first(pair), v = pairs_.second(pair);
        const double square = (complex_.position(u) - complex_.position(v)).squaredNorm();
        double area = square;
        if (refusal == Refusal::fold) area = std::max(area, fold_factor * distance_weight_);
        lifted_[pair] |= refusal == Refusal::link ? link_bit : fold_bit;
        queue_.set(pair, std::max(cost, square * area * weight(u, v)));
        veto(pair);
    }

    // A pair that turns out dearer than it seemed, and than the next one, waits for its turn.
    bool postpone(Index pair, double cost) {
        if constexpr (LazyQueue<Queue>) {
            // To try a pair at a hub is a long look at it: not before its turn.
            const bool is_long = complex_.is_hub(pairs_.first(pair)) || complex_.is_hub(pairs_.second(pair));
            if (is_long) cost *= queue_.slack();
        }
        if (!queue_.has_before(cost)) return false;
        queue_.set(pair, cost);
        return true;
    }

    void collapse(Index survivor, Index gone, Index pair, const Candidate& to) {
        const Vector3& p = to.point;
        recorder_.collapsing(complex_, survivor, gone, to);
        metric_.collapsing(complex_, pairs_, survivor, gone, p);
        wedges_.collapsing(complex_, survivor, gone, p);
        degenerate_.collapsing(complex_, pairs_, pair);
        if (curves_) curves_->collapsing(survivor, gone);
        if (borders_) borders_->collapsing(pairs_, survivor, gone, pair);
        complex_.collapse(survivor, gone, p);
        locked_[survivor] |= locked_[gone];
        killed_.clear();
        pairs_.merge(complex_, survivor, gone, killed_, changes_);
        for (const Index killed : killed_) queue_.erase(killed);
        if (borders_) borders_->collapsed(complex_, pairs_, survivor);
        metric_.collapsed(complex_, pairs_, survivor, changes_);
        ++result_.collapses;
        for (const PairTable::Change& change : changes_) {
            if (change.neighbour.pair != no_index) renew(change.neighbour.pair);
        }
        for (const PairTable::Change& change : changes_) {
            const Staleness staleness = metric_.staleness(change);
            if (staleness == Staleness::none) continue;
            std::uint8_t& has_vetoed = has_vetoed_[change.neighbour.vertex];
            if (staleness == Staleness::lazily && !std::exchange(has_vetoed, std::uint8_t{0})) continue;
            pairs_.for_each_pair(change.neighbour.vertex, [&](Neighbour n) {
                if (n.vertex == survivor) return;
                const bool was_refused = lifted_[n.pair] || !queue_.contains(n.pair);
                if (staleness == Staleness::now || was_refused) evaluate(n.pair);
            });
        }
    }

    // Takes the next rung. False: there is none left.
    bool climb(const LoopOptions& options) {
        if (delete_double_faces(options)) {
            ++result_.rungs[static_cast<std::size_t>(Rung::double_faces)];
            return true;
        }
        while (++rung_ < rung_kinds) {
            const auto rung = static_cast<Rung>(rung_);
            if (!take(rung, options)) continue;
            ++result_.rungs[rung_];
            return true;
        }
        return false;
    }

    // False where the rung would change nothing.
    bool take(Rung rung, const LoopOptions& options) {
        switch (rung) {
            case Rung::tiny_components:
                return delete_components(options, options.tiny_component);
            case Rung::any_component:
                // Kept seams and groups are a wish of the user's, like locks: a large part is not given up
                // for them.
                return wedges_.empty() && !keeps_groups() &&
                       delete_components(options, std::numeric_limits<double>::infinity());
            default:
                return relax(rules_, rung, keeps_groups() ? Groups::kept : Groups::free);
        }
    }

    // Down to the target. No surface is lost, but perhaps a group.
    bool delete_double_faces(const LoopOptions& options) {
        if (keeps_groups()) return false;
        bool any = false;
        for (const Index f : double_faces(complex_, poll_)) {
            if (complex_.face_count() <= options.target_faces) break;
            const Triangle corners = complex_.triangle(f);
            recorder_.deleting(f);
            complex_.remove_face(f);
            pairs_.face_removed(complex_, corners);
            any = true;
        }
        if (any && borders_)
            borders_.emplace(complex_, pairs_, no_index, poll_);  // edges may have become open
        return any;
    }

    bool keeps_groups() const { return curves_ && !curves_->empty(); }

    // Down to the target; never the largest.
    bool delete_components(const LoopOptions& options, double largest_diagonal) {
        bool any = false;
        for (const Component& component : expendable_components(complex_, locked_, largest_diagonal, poll_)) {
            if (complex_.face_count() <= options.target_faces) break;
            delete_component(component);
            any = true;
        }
        return any;
    }

    void delete_component(const Component& component) {
        killed_.clear();
        for (const Index f : component.faces) {
            const Triangle t = complex_.triangle(f);
            recorder_.deleting(f);
            complex_.remove_face(f);
            for (const Index v : t) {
                if (complex_.degree(v) == 0) pairs_.kill_all(v, killed_);
            }
        }
        for (const Index pair : killed_) queue_.erase(pair);
        ++result_.components_deleted;
    }

    // As long as it takes, about, with the tests and without the pairs around it.
    static constexpr std::uint64_t evaluations_per_collapse = 8;
    static constexpr std::uint8_t link_bit = 1, fold_bit = 2;
    static constexpr double fold_factor = 2;

    Complex& complex_;
    PairTable& pairs_;
    Wedges& wedges_;
    std::vector<std::uint8_t>& locked_;
    Metric& metric_;
    Recorder& recorder_;
    GroupCurves* curves_;
    Legality legality_;
    DegenerateFaces degenerate_;
    std::optional<BorderLoops> borders_;
    double distance_weight_ = 0;
    Queue queue_;
    std::vector<std::uint8_t> has_vetoed_;  // of a vertex: some of its pairs may have been refused
    std::vector<std::uint8_t> lifted_;      // of a pair: bits of the rules that no longer hold it
    Rules rules_;
    LoopResult result_;
    std::size_t rung_ = 0;
    std::size_t first_count_ = 0;
    std::size_t seeded_at_ = 0;  // faces there were
    std::size_t target_count_ = 0;
    std::function<Continue(double)> progress_;
    Asker asker_{[this] { return ask(); }};
    Poll poll_;
    std::vector<Index> killed_;
    std::vector<PairTable::Change> changes_;
};

}  // namespace engine
FAQEM_NAMESPACE_END
