#pragma once
/// \file
/// The queue of candidate collapses: what the engine asks of one, and an addressable heap.

#include <concepts>
#include <cstddef>
#include <vector>

#include "faqem/engine/util/cancellation.hpp"
#include "faqem/export.hpp"
#include "faqem/mesh.hpp"

FAQEM_NAMESPACE_BEGIN
namespace engine {

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
    // Is there a pair that would come before the one just popped, were that put back with this cost?
    { const_queue.has_cheaper(cost) } -> std::same_as<bool>;
};

/// A queue that can do with old costs: what a collapse has made dearer, most often, is measured again when its
/// turn comes.
template <class Q>
concept LazyQueue = CollapseQueue<Q> && requires(Q queue, const Q& const_queue, Index pair) {
    // The cost of the pair has changed. False: it must be set.
    { queue.mark_stale(pair) } -> std::same_as<bool>;
    // What comes out may cost so many times as much as what is still in.
    { const_queue.approximation_factor() } -> std::same_as<double>;
};

/// A queue that goes about it otherwise far from the end than near it.
template <class Q>
concept TargetDependentQueue = CollapseQueue<Q> &&
    requires(Q queue, std::size_t pairs, CancellationCheck check_cancelled) {
    {queue.set_target(pairs, check_cancelled)};  // so many will be left; what takes long asks the poll
};

/// A four-ary heap that knows where each pair is. Equal costs come out by index. set, erase and pop take
/// O(log n).
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
    std::vector<Index> heap_index_;  // of a pair in heap_, or no_index
};

}  // namespace engine
FAQEM_NAMESPACE_END
