#pragma once
/// \file
/// Lists of indices: that of all, and many short ones, each stored contiguously. Unlike the nodes of a linked
/// list, the entries of such a list can be prefetched together.

#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

#include "faqem/export.hpp"
#include "faqem/mesh.hpp"

FAQEM_ENGINE_BEGIN

/// The numbers 0, 1 ... count - 1. O(count)
inline std::vector<Index> all_indices(std::size_t count) {
    std::vector<Index> result(count);
    std::iota(result.begin(), result.end(), Index{0});
    return result;
}

/// Handle of a list. Valid for one IndexLists object only.
struct IndexList {
    Index offset = 0;        ///< in granules; 0: no memory allocated
    std::uint32_t size = 0;  ///< number of entries
};

/// Memory of all lists. A list that outgrows its capacity moves to new memory of 1.5 times its size. The
/// old memory is not reused, so that the total is a small multiple of the lists' length.
class IndexLists {
public:
    IndexLists() : numbers_(granule_size, 0) {}

    /// Entries of a list of this object. Valid until the next assign() or allocate().
    std::span<const Index> operator[](const IndexList& list) const {
        return {numbers_.data() + first(list.offset), list.size};
    }

    /// Reserves memory for lists to be allocated.
    /// \param size   total number of entries
    /// \param lists  number of lists
    void reserve(std::size_t size, std::size_t lists) {
        numbers_.reserve(granule_size + size + granule_size * lists);
    }

    /// Allocates an empty list. Amortised O(capacity)
    /// \param capacity  number of entries that the list can hold without moving
    IndexList allocate(std::uint32_t capacity) {
        // One entry stores the capacity.
        const std::size_t granules = (std::size_t{capacity} + granule_size) / granule_size;
        const std::size_t at = numbers_.size();
        numbers_.resize(at + granule_size * granules);
        numbers_[at] = static_cast<Index>(granule_size * granules - 1);
        return {static_cast<Index>(at / granule_size), 0};
    }

    /// Appends a number. O(1)
    /// \pre the size of the list is below its capacity
    void push_back(IndexList& list, Index number) { numbers_[first(list.offset) + list.size++] = number; }

    /// Replaces the entries of a list. Amortised O(size of `numbers`)
    /// \param numbers  must not be stored in this object
    void assign(IndexList& list, std::span<const Index> numbers) {
        const auto size = static_cast<std::uint32_t>(numbers.size());
        if (size > numbers_[granule_size * std::size_t{list.offset}]) list = allocate(size + size / 2);
        list.size = 0;
        for (const Index number : numbers) push_back(list, number);
    }

private:
    static constexpr std::size_t granule_size = 4;
    static std::size_t first(Index offset) { return granule_size * std::size_t{offset} + 1; }

    // Each list begins at a multiple of granule_size with its capacity. The first granule is unused.
    std::vector<Index> numbers_;
};

FAQEM_ENGINE_END
