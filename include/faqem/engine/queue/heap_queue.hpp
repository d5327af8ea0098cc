#pragma once
/// \file
/// An addressable heap of pairs.

#include <cstddef>
#include <vector>

#include "faqem/engine/queue/collapse_queue.hpp"
#include "faqem/export.hpp"
#include "faqem/mesh.hpp"

FAQEM_ENGINE_BEGIN

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
            for (std::size_t child = begin; child < end; ++child)
                if (heap_[child] < (best == i ? entry : heap_[best])) best = child;
            if (best == i) break;
            put(i, heap_[best]);
            i = best;
        }
        put(i, entry);
    }

    std::vector<Entry> heap_;
    std::vector<Index> heap_index_;  // position of each pair in heap_, or no_index
};

FAQEM_ENGINE_END
