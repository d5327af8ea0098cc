#pragma once
/// \file
/// Items sorted by small numbers.

#include <cstddef>
#include <numeric>
#include <span>
#include <vector>

#include "faqem/export.hpp"

FAQEM_NAMESPACE_BEGIN
namespace detail {

/// Items in buckets; those of one bucket lie together, in the order in which they came.
template <class Item>
class Buckets {
public:
    Buckets() = default;
    /// \param count     of buckets
    /// \param for_each  is called twice, with put(bucket, item); must call it for each item, the same both
    ///                  times
    /// O(buckets + items)
    template <class ForEach>
    Buckets(std::size_t count, ForEach&& for_each) : begin_(count + 1, 0) {
        for_each([&](std::size_t bucket, const Item&) { ++begin_[bucket + 1]; });
        std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
        items_.resize(begin_.back());
        std::vector<std::size_t> next(begin_.begin(), begin_.end() - 1);
        for_each([&](std::size_t bucket, const Item& item) { items_[next[bucket]++] = item; });
    }

    std::span<const Item> operator[](std::size_t bucket) const {
        return std::span(items_).subspan(begin_[bucket], begin_[bucket + 1] - begin_[bucket]);
    }

private:
    std::vector<std::size_t> begin_;
    std::vector<Item> items_;
};

}  // namespace detail
FAQEM_NAMESPACE_END
