#pragma once
/// \file
/// Concepts of collapse queues, and an addressable heap.

#include <concepts>
#include <cstddef>
#include <vector>

#include "faqem/engine/util/cancellation.hpp"
#include "faqem/export.hpp"
#include "faqem/mesh.hpp"

FAQEM_NAMESPACE_BEGIN
namespace engine {

/// A priority queue of pairs with costs, finite and >= 0; cheapest first. The order of equal costs must be
/// deterministic: it may depend only on the sequence of calls.
template <class Q>
concept CollapseQueue = requires(Q queue, const Q& const_queue, Index pair, double cost, std::size_t pairs) {
    {queue.reserve(pairs)};                  // clears the queue; pairs in [0, pairs) may be inserted
    {queue.set(pair, cost)};                 // inserts the pair or changes its cost
    {queue.erase(pair)};                     // removes the pair; does nothing if it is not in the queue
    { queue.pop() } -> std::same_as<Index>;  // removes and returns the cheapest pair; not empty
    { const_queue.empty() } -> std::same_as<bool>;
    { const_queue.contains(pair) } -> std::same_as<bool>;
    // Whether a pair in the queue would be popped before the pair just popped, if that were inserted again
    // with this cost.
    { const_queue.has_cheaper(cost) } -> std::same_as<bool>;
};

/// A queue that tolerates outdated costs. A collapse usually increases the costs of the pairs around it;
/// these are computed again when the pair is popped.
template <class Q>
concept LazyQueue = CollapseQueue<Q> && requires(Q queue, const Q& const_queue, Index pair) {
    // Marks the cost of a pair as outdated. Returns false if set() must be called instead.
    { queue.mark_stale(pair) } -> std::same_as<bool>;
    // The cost of a popped pair is at most this factor times the lowest cost in the queue.
    { const_queue.approximation_factor() } -> std::same_as<double>;
};

/// A queue whose strategy depends on the distance from the target.
template <class Q>
concept TargetDependentQueue = CollapseQueue<Q> &&
    requires(Q queue, std::size_t pairs, CancellationCheck check_cancelled) {
    // Sets the expected number of pairs at the target. Long loops call check_cancelled.
    {queue.set_target(pairs, check_cancelled)};
};

/// A four-ary heap that stores the position of each pair. Equal costs are popped by index. set(), erase()
/// and pop() take O(log n), the other functions O(1). 20 bytes per pair.
class HeapQueue {
public:
    void reserve(std::size_t pairs) {
        heap_index_.assign(pairs, no_index);
        heap_.clear();
        heap_.reserve(pairs);
    }

    bool empty() const { return heap_.empty(); }
    bool contains(Index pair) const { return heap_index_[pair] != no_index; }
    bool has_cheaper(double cost) const { return !heap_.empty() && heap_.front().cost < cost; }

    void set(Index pair, double cost) {
        std::size_t i = heap_index_[pair];
        if (i == no_index) {
            i = heap_.size();
            heap_.push_back({cost, pair});
            heap_index_[pair] = static_cast<Index>(i);
        } else {
            heap_[i].cost = cost;
        }
        sift_down(sift_up(i));
    }

    void erase(Index pair) {
        const std::size_t i = heap_index_[pair];
        if (i == no_index) return;
        heap_index_[pair] = no_index;
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
        heap_index_[entry.pair] = static_cast<Index>(i);
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
    std::vector<Index> heap_index_;  // position of each pair in heap_, or no_index
};

}  // namespace engine
FAQEM_NAMESPACE_END
