#pragma once
/// \file
/// The queue of candidate collapses: what the engine asks of one, an addressable heap, and buckets.

#include <algorithm>
#include <bit>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "faqem/mesh.hpp"

namespace faqem::engine {

/// A set of pairs with costs, finite and >= 0. The cheapest comes first; which of equal ones does depends on
/// nothing but the calls.
template <class Q>
concept CollapseQueue = requires(Q queue, const Q& const_queue, Index pair, double cost, std::size_t pairs) {
    {queue.reserve(pairs)};                  // room for pairs [0, pairs)
    {queue.set(pair, cost)};                 // inserts, or changes the cost
    {queue.erase(pair)};                     // does nothing when the pair is not in it
    { queue.pop() } -> std::same_as<Index>;  // removes and returns the cheapest; not empty
    { const_queue.empty() } -> std::same_as<bool>;
    { const_queue.contains(pair) } -> std::same_as<bool>;
    // Is there a pair that would come before one put in with this cost?
    { const_queue.has_before(cost) } -> std::same_as<bool>;
};

/// A four-ary heap that knows where each pair is. Equal costs come out by index. set, erase and pop take
/// O(log n).
class HeapQueue {
public:
    void reserve(std::size_t pairs) {
        place_.assign(pairs, no_index);
        heap_.clear();
        heap_.reserve(pairs);
    }

    bool empty() const { return heap_.empty(); }
    bool contains(Index pair) const { return place_[pair] != no_index; }
    bool has_before(double cost) const { return !heap_.empty() && heap_.front().cost < cost; }

    void set(Index pair, double cost) {
        std::size_t i = place_[pair];
        if (i == no_index) {
            i = heap_.size();
            heap_.push_back({cost, pair});
            place_[pair] = static_cast<Index>(i);
        } else {
            heap_[i].cost = cost;
        }
        sift_down(sift_up(i));
    }

    void erase(Index pair) {
        const std::size_t i = place_[pair];
        if (i == no_index) return;
        place_[pair] = no_index;
        const Entry last = heap_.back();
        heap_.pop_back();
        if (i == heap_.size()) return;
        put(i, last);
        sift_down(sift_up(i));
    }

    Index pop() {
        const Index pair = heap_.front().pair;
        erase(pair);
        return pair;
    }

private:
    struct Entry {
        double cost;
        Index pair;
        bool operator<(const Entry& o) const { return cost < o.cost || (cost == o.cost && pair < o.pair); }
    };
    static constexpr std::size_t arity = 4;

    void put(std::size_t i, const Entry& entry) {
        heap_[i] = entry;
        place_[entry.pair] = static_cast<Index>(i);
    }

    std::size_t sift_up(std::size_t i) {
        const Entry entry = heap_[i];
        while (i > 0) {
            const std::size_t parent = (i - 1) / arity;
            if (!(entry < heap_[parent])) break;
            put(i, heap_[parent]);
            i = parent;
        }
        put(i, entry);
        return i;
    }

    void sift_down(std::size_t i) {
        const Entry entry = heap_[i];
        for (;;) {
            const std::size_t begin = arity * i + 1;
            const std::size_t end = begin + arity < heap_.size() ? begin + arity : heap_.size();
            std::size_t best = i;
            for (std::size_t child = begin; child < end; ++child) {
                if (heap_[child] < (best == i ? entry : heap_[best])) best = child;
            }
            if (best == i) break;
            put(i, heap_[best]);
            i = best;
        }
        put(i, entry);
    }

    std::vector<Entry> heap_;
    std::vector<Index> place_;  // of a pair in heap_, or no_index
};

/// Costs within a sixty-fourth of a power of two of each other are one, and equal ones come out in the order
/// in which they came in: for metrics whose costs are estimates, several times as fast as the heap. All calls
/// take O(1), amortised.
class BucketQueue {
public:
    BucketQueue() : buckets_(count) {}

    void reserve(std::size_t pairs) {
        bucket_of_.assign(pairs, nowhere);
        for (Bucket& bucket : buckets_) bucket = {};
        size_ = 0;
        lowest_ = count;
    }

    bool empty() const { return size_ == 0; }
    bool contains(Index pair) const { return bucket_of_[pair] != nowhere; }
    bool has_before(double cost) const { return lowest_ < bucket_for(cost); }

    void set(Index pair, double cost) {
        const std::uint16_t to = bucket_for(cost);
        std::uint16_t& at = bucket_of_[pair];
        if (at == to) return;
        size_ += at == nowhere;
        at = to;
        buckets_[to].pairs.push_back(pair);
        if (to < lowest_) lowest_ = to;
        find_lowest();
    }

    void erase(Index pair) {
        if (!contains(pair)) return;
        bucket_of_[pair] = nowhere;
        --size_;
        find_lowest();
    }

    Index pop() {
        const Index pair = buckets_[lowest_].pairs[buckets_[lowest_].first];
        erase(pair);
        return pair;
    }

private:
    /// Pairs in order of arrival. One that has left since is still there: bucket_of_ tells.
    struct Bucket {
        std::vector<Index> pairs;
        std::size_t first = 0;
    };
    /// Bits of a float but the sign, down to six of its fraction.
    static constexpr std::uint16_t count = 1 << 14, nowhere = count;
    static constexpr double dearest = std::numeric_limits<float>::max();

    static std::uint16_t bucket_for(double cost) {
        return static_cast<std::uint16_t>(
            std::bit_cast<std::uint32_t>(static_cast<float>(std::min(cost, dearest))) >> 17);
    }

    // To the first pair that is still where it was put.
    void find_lowest() {
        if (size_ == 0) lowest_ = count;
        for (; lowest_ < count; ++lowest_) {
            Bucket& bucket = buckets_[lowest_];
            while (bucket.first < bucket.pairs.size() && bucket_of_[bucket.pairs[bucket.first]] != lowest_)
                ++bucket.first;
            if (bucket.first < bucket.pairs.size()) return;
            bucket = {};
        }
    }

    std::vector<Bucket> buckets_;
    std::vector<std::uint16_t> bucket_of_;  // of a pair, or nowhere
    std::size_t size_ = 0;
    std::uint16_t lowest_ = count;  // all buckets below are empty
};

}  // namespace faqem::engine
