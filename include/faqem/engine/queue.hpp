#pragma once
/// \file
/// The queue of candidate collapses: what the engine asks of one, an addressable heap, and buckets.

#include <algorithm>
#include <array>
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
    // Is there a pair that would come before the one just popped, were that put back with this cost?
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

/// Buckets of nearly equal costs, for metrics whose costs are estimates: several times as fast as the heap.
///
/// Pairs are cut into blocks by index, so that the engine stays in one place for a while and finds it in the
/// cache. Costs are cut into levels, two to a power of two. The lowest level goes first, block by block; in
/// a block, costs within a sixty-fourth of a power of two of each other are one and come out in the order in
/// which they came to the level. What comes in below the level elsewhere waits until the block is done. All
/// calls take O(1), amortised.
class BucketQueue {
public:
    /// \param block_bits  a block has 2^block_bits pairs; 0: one block, or several where that would be large
    explicit BucketQueue(unsigned block_bits = 0) : wanted_bits_(block_bits), buckets_(bucket_count) {}

    void reserve(std::size_t pairs) {
        block_bits_ = wanted_bits_ > 0                       ? wanted_bits_
                      : pairs <= std::size_t{1} << most_bits ? most_bits
                                                             : usual_bits;
        blocks_ = (pairs >> block_bits_) + 1;
        place_.assign(pairs, nowhere);
        waiting_.assign(level_count * blocks_, {});
        live_.fill(0);
        for (Bucket& bucket : buckets_) bucket = {};
        size_ = open_size_ = open_block_ = open_level_ = ground_ = 0;
        lowest_ = bucket_count;
    }

    /// Makes one level of the lowest ones, which have at most so many pairs together. Who knows that all of
    /// these will go may let them go block by block. O(pairs + levels times blocks)
    void merge_lowest(std::size_t pairs) {
        std::size_t level = ground_;
        for (std::size_t below = 0; level + 1 < level_count; ++level) {
            below += live_[level];
            if (below > pairs) break;
        }
        for (std::size_t merged = ground_; merged < level; ++merged) {
            live_[level] += std::exchange(live_[merged], 0);
            for (std::size_t b = 0; b < blocks_; ++b) {
                const std::vector<Index> more = std::exchange(waiting_[merged * blocks_ + b], {});
                std::vector<Index>& to = waiting_[level * blocks_ + b];
                to.insert(to.end(), more.begin(), more.end());
            }
        }
        ground_ = level;
        open_level_ = std::max(open_level_, level);
    }

    bool empty() const { return size_ == 0; }
    bool contains(Index pair) const { return place_[pair] != nowhere; }

    bool has_before(double cost) const {
        const std::uint16_t bucket = bucket_for(cost);
        if (open_size_ > 0) return lowest_ < bucket;
        return size_ > 0 && level_of(bucket) > open_level_ && level_of(bucket) > lowest_level();
    }

    void set(Index pair, double cost) {
        const std::uint16_t bucket = bucket_for(cost);
        const std::size_t level = level_of(bucket), block = pair >> block_bits_;
        const bool opens = block == open_block_ && level <= open_level_;
        if (place_[pair] == (opens ? bucket | open : bucket)) return;
        const std::uint16_t before = leave(pair);
        ++size_;
        ++live_[level];
        if (opens) {
            put(pair, bucket);
        } else {
            place_[pair] = bucket;
            // Else it is among those that wait already.
            if (before >= open || level_of(before) != level)
                waiting_[level * blocks_ + block].push_back(pair);
        }
        find_lowest();
    }

    void erase(Index pair) {
        if (!contains(pair)) return;
        leave(pair);
        find_lowest();
    }

    Index pop() {
        while (open_size_ == 0) open_next();
        const Index pair = buckets_[lowest_].pairs[buckets_[lowest_].first];
        erase(pair);
        return pair;
    }

private:
    /// Pairs in order of arrival. One that has left since is still there: place_ tells.
    struct Bucket {
        std::vector<Index> pairs;
        std::size_t first = 0;
    };
    /// The bits of a float but the sign, down to six of its fraction; a level is thirty-two buckets.
    static constexpr std::uint16_t bucket_count = 1 << 14;
    /// A place is a bucket where the pair waits for its block, the same with this bit where it is in it now.
    static constexpr std::uint16_t open = 1 << 14, nowhere = 1 << 15;
    static constexpr std::size_t level_count = bucket_count / 32;
    static constexpr unsigned most_bits = 18, usual_bits = 14;
    static constexpr double dearest = std::numeric_limits<float>::max();

    static std::uint16_t bucket_for(double cost) {
        return static_cast<std::uint16_t>(
            std::bit_cast<std::uint32_t>(static_cast<float>(std::min(cost, dearest))) >> 17);
    }
    std::size_t level_of(std::uint16_t place) const {
        return std::max<std::size_t>(place % bucket_count / 32, ground_);
    }

    void put(Index pair, std::uint16_t bucket) {
        ++open_size_;
        place_[pair] = bucket | open;
        buckets_[bucket].pairs.push_back(pair);
        lowest_ = std::min(lowest_, bucket);
    }

    /// \return the place it had
    std::uint16_t leave(Index pair) {
        const std::uint16_t place = std::exchange(place_[pair], nowhere);
        if (place == nowhere) return place;
        --size_;
        --live_[level_of(place)];
        open_size_ -= (place & open) != 0;
        return place;
    }

    /// To the first pair that is still where it was put.
    void find_lowest() {
        if (open_size_ == 0) lowest_ = bucket_count;
        for (; lowest_ < bucket_count; ++lowest_) {
            Bucket& bucket = buckets_[lowest_];
            while (bucket.first < bucket.pairs.size() &&
                   place_[bucket.pairs[bucket.first]] != (lowest_ | open))
                ++bucket.first;
            if (bucket.first < bucket.pairs.size()) return;
            bucket.pairs.clear();
            bucket.first = 0;
        }
    }

    std::size_t lowest_level() const {
        return static_cast<std::size_t>(
            std::find_if(live_.begin(), live_.end(), [](std::size_t n) { return n > 0; }) - live_.begin());
    }

    /// Opens the next block, in a circle, that may have pairs on the lowest level. \pre size_ > 0
    void open_next() {
        open_level_ = lowest_level();
        std::vector<Index>* waiting = nullptr;
        do {
            open_block_ = open_block_ + 1 < blocks_ ? open_block_ + 1 : 0;
            waiting = &waiting_[open_level_ * blocks_ + open_block_];
        } while (waiting->empty());
        for (const Index pair : std::exchange(*waiting, {})) {
            const std::uint16_t place = place_[pair];
            if (place < open && level_of(place) == open_level_) put(pair, place);
        }
        find_lowest();
    }

    unsigned wanted_bits_, block_bits_ = most_bits;
    std::vector<Bucket> buckets_;
    std::uint16_t lowest_ = bucket_count;             // all buckets below are empty
    std::vector<std::vector<Index>> waiting_;         // pairs by level and block; some have left since
    std::array<std::size_t, level_count> live_ = {};  // pairs on each level
    std::vector<std::uint16_t> place_;
    std::size_t blocks_ = 1, size_ = 0;
    std::size_t open_size_ = 0, open_block_ = 0, open_level_ = 0;  // what is in the buckets
    std::size_t ground_ = 0;                                       // no level is below
};

}  // namespace faqem::engine
