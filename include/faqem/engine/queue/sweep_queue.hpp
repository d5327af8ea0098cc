#pragma once
/// \file
/// A queue that goes over the surface in rounds.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "faqem/engine/queue/bucket_queue.hpp"
#include "faqem/engine/util/cancellation.hpp"
#include "faqem/export.hpp"

FAQEM_NAMESPACE_BEGIN
namespace engine {

/// Far from the end, what goes matters more than in which order: a round gives out all pairs up to a limit,
/// by index, and the limit of the next round is higher. So the engine walks over the surface, and finds in the
/// cache what it needs. Pairs around a collapse wait for the next round, with the cost that they had: it is
/// measured again where that is within the limit, once for all the collapses beside the pair. Near the end the
/// rest goes into buckets.
///
///     limit = what the cheapest of the pairs cost at most, up to three of ten where nearly all will go
///     until there are hardly more pairs than at the end:
///         give out pairs up to the limit, unless an end has moved in this round
///         limit *= how many times more pairs there are than at the end, from 1.4 to 4
///
/// set, erase and mark_stale take O(1); all pops of a round O(pairs).
class SweepQueue {
public:
    /// \param few  so many pairs go into buckets at once: among few, each counts
    explicit SweepQueue(std::size_t few = 0) : few_(few) {}

    void reserve(std::size_t pairs) {
        costs_.assign(pairs, absent);
        rounds_.assign(pairs, 0);
        size_ = 0;
        at_ = pairs;
        limit_ = lowest_ = -1;
        round_ = 0;
        is_over_ = false;
    }

    /// \param pairs  that will be left at the end; 0, as without: there is no end in sight
    /// \param check_cancelled   for pop(), which may walk along all pairs
    void set_target(std::size_t pairs, CancellationCheck check_cancelled = {}) {
        end_ = static_cast<double>(pairs);
        check_cancelled_ = check_cancelled;
    }

    bool empty() const { return is_over_ ? buckets_.empty() : size_ == 0; }
    bool contains(Index pair) const { return is_over_ ? buckets_.contains(pair) : costs_[pair] != absent; }
    bool has_cheaper(double cost) const {
        return is_over_ ? buckets_.has_cheaper(cost) : size_ > 0 && as_float(cost) > limit_;
    }

    void set(Index pair, double cost) {
        if (is_over_) return buckets_.set(pair, cost);
        size_ += costs_[pair] == absent;
        costs_[pair] = as_float(cost);
    }

    void erase(Index pair) {
        if (is_over_) return buckets_.erase(pair);
        size_ -= costs_[pair] != absent;
        costs_[pair] = absent;
    }

    bool mark_stale(Index pair) {
        if (is_over_) return false;
        rounds_[pair] = round_;
        return costs_[pair] != absent;
    }

    double approximation_factor() const { return is_over_ ? 1 : most_growth; }

    Index pop() {
        for (;;) {
            if (is_over_) return buckets_.pop();
            for (; at_ < costs_.size(); ++at_) {
                if (at_ % polled == 0) check_cancelled_(operations);
                const float cost = costs_[at_];
                if (cost <= limit_ && rounds_[at_] != round_) {
                    const auto pair = static_cast<Index>(at_++);
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
    /// The share of all pairs that may go in any order, where nearly all will go; of more, the error would grow.
    static constexpr double first_share = 0.3;
    static constexpr double most_growth = 4, least_growth = 1.41421356;
    /// Times as many pairs as at the end are near it.
    static constexpr double near = 1.25;

    static float as_float(double cost) { return static_cast<float>(std::min<double>(cost, max_cost)); }

    double left() const {
        return end_ > 0 ? static_cast<double>(size_) / end_ : std::numeric_limits<double>::infinity();
    }

    void begin_round() {
        const double times = left();
        if (!(times > near) || size_ <= few_) return fill_buckets();
        limit_ = limit_ < 0 ? first_limit(1 - 1 / times) : next_limit(times);
        at_ = 0;
        lowest_ = absent;
        if (++round_ == 0) {
            std::fill(rounds_.begin(), rounds_.end(), std::uint8_t{0});
            round_ = 1;
        }
    }

    /// \param going  the share of all pairs that will go
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
        const double growth = std::clamp(times, least_growth, most_growth);
        return as_float(std::max(growth * static_cast<double>(limit_), static_cast<double>(lowest_)));
    }

    void fill_buckets() {
        is_over_ = true;
        buckets_.reserve(costs_.size());
        for (std::size_t i = 0; i < costs_.size(); ++i) {
            check_cancelled_();
            if (costs_[i] != absent) buckets_.set(static_cast<Index>(i), static_cast<double>(costs_[i]));
        }
        std::vector<float>().swap(costs_);
        std::vector<std::uint8_t>().swap(rounds_);
    }

    static constexpr std::size_t samples = 4096;
    static constexpr std::size_t polled = 64, operations = 4;  // a look at 16 is one

    std::vector<float> costs_;          // of pairs that are in; else `absent`
    std::vector<std::uint8_t> rounds_;  // in which an end moved last
    std::size_t few_, size_ = 0;
    std::size_t at_ = 0;  // how far the round has come
    double end_ = 0;
    float limit_ = -1;   // below 0: before the first round
    float lowest_ = -1;  // of what this round has passed over
    std::uint8_t round_ = 0;
    bool is_over_ = false;
    CancellationCheck check_cancelled_;
    BucketQueue buckets_;
};

static_assert(LazyQueue<SweepQueue> && TargetDependentQueue<SweepQueue>);

}  // namespace engine
FAQEM_NAMESPACE_END
