#pragma once
/// \file
/// A queue that pops pairs in rounds, each of them a sweep over all pairs.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "faqem/engine/queue/bucket_queue.hpp"
#include "faqem/export.hpp"

FAQEM_NAMESPACE_BEGIN
namespace engine {

/// A queue that pops, in each round, all pairs up to a cost limit in the order of their index, and then
/// raises the limit. Far from the target the exact order of collapses matters little, and index order uses
/// the cache well. Pairs around a collapse wait for the next round with their outdated cost; if it is
/// within the limit, the cost is computed again, once for all collapses next to the pair. Near the target
/// the remaining pairs go into a bucket queue.
///
///     limit = quantile of the initial costs: 0.3 times the squared fraction of pairs to be removed
///     while the number of pairs is well above that at the target:
///         pop the pairs up to the limit, except for those marked as stale in this round
///         limit *= number of pairs / number of pairs at the target, clamped to [1.41, 4]
///
/// set(), erase() and mark_stale() take O(1); all pops of a round together take O(pairs).
class SweepQueue {
public:
    static constexpr bool is_exact = false;

    /// \param min_sweep_pairs  up to this number of pairs, only the bucket queue is used: with few pairs the
    ///     order matters
    explicit SweepQueue(std::size_t min_sweep_pairs = 0) : min_sweep_pairs_(min_sweep_pairs) {}

    void reserve(std::size_t pairs) {
        costs_.assign(pairs, absent);
        rounds_.assign(pairs, 0);
        size_ = 0;
        next_pair_ = pairs;
        limit_ = lowest_ = -1;
        round_ = 0;
        uses_buckets_ = false;
    }

    /// Sets the target.
    /// \param pairs            expected number of pairs at the target; 0 (as without this call): unknown
    void set_target(std::size_t pairs) { target_pairs_ = static_cast<double>(pairs); }

    bool empty() const { return uses_buckets_ ? buckets_.empty() : size_ == 0; }
    bool contains(Index pair) const {
        return uses_buckets_ ? buckets_.contains(pair) : costs_[pair] != absent;
    }
    bool has_cheaper(double cost) const {
        return uses_buckets_ ? buckets_.has_cheaper(cost) : size_ > 0 && scaled_cost(cost) > limit_;
    }

    void set(Index pair, double cost) {
        if (uses_buckets_) return buckets_.set(pair, cost);
        size_ += costs_[pair] == absent;
        costs_[pair] = scaled_cost(cost);
    }

    void erase(Index pair) {
        if (uses_buckets_) return buckets_.erase(pair);
        size_ -= costs_[pair] != absent;
        costs_[pair] = absent;
    }

    bool mark_stale(Index pair) {
        if (uses_buckets_) return false;
        rounds_[pair] = round_;
        return costs_[pair] != absent;
    }

    double approximation_factor() const { return uses_buckets_ ? 1 : max_growth; }

    Index pop() {
        for (;;) {
            if (uses_buckets_) return buckets_.pop();
            for (; next_pair_ < costs_.size(); ++next_pair_) {
                const float cost = costs_[next_pair_];
                if (cost <= limit_ && rounds_[next_pair_] != round_) {
                    const auto pair = static_cast<Index>(next_pair_++);
                    erase(pair);
                    return pair;
                }
                lowest_ = std::min(lowest_, cost);
            }
            begin_round();
        }
    }

private:
    static constexpr float absent = std::numeric_limits<float>::infinity();
    static constexpr float max_cost = std::numeric_limits<float>::max();
    /// The first limit is this quantile of the initial costs, times the squared fraction of pairs to be
    /// removed. Larger values increase the error.
    static constexpr double first_share = 0.3;
    static constexpr double max_growth = 4, min_growth = 1.41421356;
    /// Below this ratio of the number of pairs to that at the target, the bucket queue is used.
    static constexpr double bucket_queue_ratio = 1.25;

    double left() const {
        return target_pairs_ > 0 ? static_cast<double>(size_) / target_pairs_
                                 : std::numeric_limits<double>::infinity();
    }

    void begin_round() {
        const double times = left();
        if (!(times > bucket_queue_ratio) || size_ <= min_sweep_pairs_) return fill_buckets();
        limit_ = limit_ < 0 ? first_limit(1 - 1 / times) : next_limit(times);
        next_pair_ = 0;
        lowest_ = absent;
        if (++round_ == 0) {
            std::fill(rounds_.begin(), rounds_.end(), std::uint8_t{0});
            round_ = 1;
        }
    }

    /// \param going  fraction of all pairs that will be removed, in (0, 1]
    float first_limit(double going) const {
        std::vector<float> some;
        for (std::size_t i = 0; i < costs_.size(); i += 1 + costs_.size() / samples)
            some.push_back(costs_[i]);
        const auto place =
            static_cast<std::ptrdiff_t>(first_share * going * going * static_cast<double>(some.size()));
        std::nth_element(some.begin(), some.begin() + place, some.end());
        return std::min(some[static_cast<std::size_t>(place)], max_cost);
    }

    float next_limit(double times) const {
        const double growth = std::clamp(times, min_growth, max_growth);
        const double next = std::max(growth * static_cast<double>(limit_), static_cast<double>(lowest_));
        return static_cast<float>(std::min<double>(next, max_cost));
    }

    void fill_buckets() {
        uses_buckets_ = true;
        buckets_.reserve(costs_.size());
        for (std::size_t i = 0; i < costs_.size(); ++i)
            if (costs_[i] != absent) buckets_.set_scaled(static_cast<Index>(i), costs_[i]);
        std::vector<float>().swap(costs_);
        std::vector<std::uint8_t>().swap(rounds_);
    }

    static constexpr std::size_t samples = 4096;

    std::vector<float> costs_;          // per pair: its scaled_cost(); `absent` if it is not in the queue
    std::vector<std::uint8_t> rounds_;  // per pair: the last round in which it was marked as stale
    std::size_t min_sweep_pairs_, size_ = 0;
    std::size_t next_pair_ = 0;  // current position in the round
    double target_pairs_ = 0;    // expected number of pairs at the target; 0: unknown
    float limit_ = -1;           // negative before the first round
    float lowest_ = -1;          // lowest cost of the pairs skipped in this round
    std::uint8_t round_ = 0;
    bool uses_buckets_ = false;
    BucketQueue buckets_;
};

static_assert(CollapseQueue<SweepQueue>);

}  // namespace engine
FAQEM_NAMESPACE_END
