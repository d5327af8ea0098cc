#pragma once
/// \file
/// Items grouped by an integer key (counting sort).

#include <cstddef>
#include <numeric>
#include <span>
#include <vector>

#include "faqem/export.hpp"

FAQEM_DETAIL_BEGIN

/// Items grouped into buckets. The items of one bucket are contiguous and keep their order of insertion.
/// \tparam Item  default-constructible and copyable
template <class Item>
class Buckets {
public:
    /// No buckets.
    Buckets() = default;
    /// Builds the buckets in two passes, one that counts and one that stores.
    /// \param count     number of buckets
    /// \param for_each  called twice with a function put(bucket, item), bucket < count. Must call put once
    ///                  for each item, with the same arguments in the same order both times.
    /// \throws whatever `for_each` throws
    /// O(buckets + items) time and memory
    template <class ForEach>
    Buckets(std::size_t count, ForEach&& for_each) : begin_(count + 1, 0) {
        for_each([&](std::size_t bucket, const Item&) { ++begin_[bucket + 1]; });
        std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
        items_.resize(begin_.back());
        std::vector<std::size_t> next(begin_.begin(), begin_.end() - 1);
        for_each([&](std::size_t bucket, const Item& item) { items_[next[bucket]++] = item; });
    }

    /// The items of one bucket; valid as long as this object. O(1)
    /// \param bucket  less than the number of buckets
    std::span<const Item> operator[](std::size_t bucket) const {
        return std::span(items_).subspan(begin_[bucket], begin_[bucket + 1] - begin_[bucket]);
    }
    /// All items, by bucket, and in them the first item of each bucket; a last entry is their number.
    std::vector<Item>& items() { return items_; }
    const std::vector<Item>& items() const { return items_; }
    const std::vector<std::size_t>& begin() const { return begin_; }

private:
    std::vector<std::size_t> begin_;
    std::vector<Item> items_;
};

FAQEM_DETAIL_END
