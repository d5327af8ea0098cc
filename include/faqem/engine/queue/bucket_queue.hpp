#pragma once
/// \file
/// A bucket queue, which treats nearly equal costs as equal.

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "faqem/engine/queue/collapse_queue.hpp"
#include "faqem/export.hpp"

FAQEM_ENGINE_BEGIN

/// A cost as the queue stores it: a multiple of 2^64. Costs are fourth powers of lengths. With a diagonal of
/// 1, those of a surface with edges of 1e-11 would be zero in single precision.
inline float scaled_cost(double cost) {
    constexpr double scale = 0x1p64, max_cost = std::numeric_limits<float>::max();
    return static_cast<float>(std::min(scale * cost, max_cost));
}

/// A queue of buckets for metrics whose costs are estimates; several times as fast as the heap. Costs in
/// the same bucket differ by at most 1/64 of a power of two and are popped in the order of insertion. All
/// functions take amortised O(1).
class BucketQueue {
public:
    BucketQueue() : buckets_(bucket_count) {}

    void reserve(std::size_t pairs) {
        bucket_of_.assign(pairs, no_bucket);
        for (Bucket& bucket : buckets_) bucket = {};
        size_ = 0;
        lowest_ = bucket_count;
    }

    bool empty() const { return size_ == 0; }
    bool contains(Index pair) const { return bucket_of_[pair] != no_bucket; }
    bool has_cheaper(double cost) const { return lowest_ < bucket_for(scaled_cost(cost)); }

    void set(Index pair, double cost) {
        const std::uint16_t bucket = bucket_for(scaled_cost(cost));
        if (bucket_of_[pair] == bucket) return;
        size_ += bucket_of_[pair] == no_bucket;
        bucket_of_[pair] = bucket;
        buckets_[bucket].pairs.push_back(pair);
        lowest_ = std::min(lowest_, bucket);
        find_lowest();
    }

    void erase(Index pair) {
        if (!contains(pair)) return;
        bucket_of_[pair] = no_bucket;
        --size_;
        find_lowest();
    }

    Index pop() {
        const Index pair = buckets_[lowest_].pairs[buckets_[lowest_].first];
        erase(pair);
        return pair;
    }

private:
    /// Pairs in the order of insertion. A pair that has left the bucket stays in the list; bucket_of_ gives
    /// its current bucket.
    struct Bucket {
        std::vector<Index> pairs;
        std::size_t first = 0;  ///< pairs before this have been popped
    };
    /// A bucket is given by the exponent and the upper six bits of the fraction of a float.
    static constexpr std::uint16_t bucket_count = 1 << 14, no_bucket = 1 << 15;

    static std::uint16_t bucket_for(float cost) {
        return static_cast<std::uint16_t>(std::bit_cast<std::uint32_t>(cost) >> 17);
    }

    /// Moves lowest_ and the bucket's `first` to the first pair that is still in its bucket.
    void find_lowest() {
        if (size_ == 0) lowest_ = bucket_count;
        for (; lowest_ < bucket_count; ++lowest_) {
            Bucket& bucket = buckets_[lowest_];
            while (bucket.first < bucket.pairs.size() && bucket_of_[bucket.pairs[bucket.first]] != lowest_)
                ++bucket.first;
            if (bucket.first < bucket.pairs.size()) return;
            bucket.pairs.clear();
            bucket.first = 0;
        }
    }

    std::vector<Bucket> buckets_;
    std::uint16_t lowest_ = bucket_count;   // all buckets below this are empty
    std::vector<std::uint16_t> bucket_of_;  // bucket of each pair, or no_bucket
    std::size_t size_ = 0;
};

FAQEM_ENGINE_END
