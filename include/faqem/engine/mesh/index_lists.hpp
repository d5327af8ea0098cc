#pragma once
/// \file
/// Many short lists of numbers, each in one piece of memory: what is in it is known before it is looked at,
/// so that the cache can fetch it all at once. A linked list is waited for item by item.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "faqem/export.hpp"
#include "faqem/mesh.hpp"

FAQEM_NAMESPACE_BEGIN
namespace engine {

/// Where a list is. Belongs to one Lists.
struct IndexList {
    Index offset = 0;  ///< in quads of numbers; 0: it has no room yet
    std::uint32_t size = 0;
};

/// The memory of all lists. What a list leaves when it moves to more room is not used again; it gets half as
/// much again as it needs, so that this adds up to a few times its length.
class IndexLists {
public:
    IndexLists() : numbers_(granule_size, 0) {}

    /// \pre of these Lists. Valid until the next assign() or allocate()
    std::span<const Index> operator[](const IndexList& list) const {
        return {numbers_.data() + first(list.offset), list.size};
    }

    /// Room for `size` numbers in all lists to come, of so many lists.
    void reserve(std::size_t size, std::size_t lists) {
        numbers_.reserve(granule_size + size + granule_size * lists);
    }

    /// A new list, empty, that needs not move for this many numbers. Amortised O(room)
    IndexList allocate(std::uint32_t capacity) {
        const std::size_t granules =
            (std::size_t{capacity} + granule_size) / granule_size;  // one number tells the room
        const std::size_t at = numbers_.size();
        numbers_.resize(at + granule_size * granules);
        numbers_[at] = static_cast<Index>(granule_size * granules - 1);
        return {static_cast<Index>(at / granule_size), 0};
    }

    /// \pre there is room for it
    void push_back(IndexList& list, Index number) { numbers_[first(list.offset) + list.size++] = number; }

    /// \param numbers  not of these Lists
    /// Amortised O(numbers)
    void assign(IndexList& list, std::span<const Index> numbers) {
        const auto size = static_cast<std::uint32_t>(numbers.size());
        if (size > numbers_[granule_size * std::size_t{list.offset}]) list = allocate(size + size / 2);
        list.size = 0;
        for (const Index number : numbers) push_back(list, number);
    }

private:
    static constexpr std::size_t granule_size = 4;
    static std::size_t first(Index offset) { return granule_size * std::size_t{offset} + 1; }

    std::vector<Index>
        numbers_;  // before each list, at a multiple of quad: its room. The first quad is nobody's
};

}  // namespace engine
FAQEM_NAMESPACE_END
