#pragma once
/// \file
/// Numbering of distinct values in the order of their first occurrence.

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <vector>

#include "faqem/mesh.hpp"

namespace faqem::detail {

/// Assigns consecutive indices to distinct values with an open-addressing hash table. The indices do not
/// depend on the hash function. Values are compared bitwise: 0 and -0 differ.
/// \tparam Value  std::array of numbers of 4 or 8 bytes
template <class Value>
class UniqueValues {
public:
    /// Returns the index of a value and adds the value if it is new. Amortised O(1).
    /// \pre fewer than no_index distinct values
    Index insert(const Value& value) {
        if (2 * (values_.size() + 1) > table_.size()) resize(table_.empty() ? 1024 : 2 * table_.size());
        const std::uint64_t h = hash(value);
        const auto tag = static_cast<std::uint32_t>(h >> 32);
        std::size_t slot = h & (table_.size() - 1);
        for (; table_[slot].index != no_index; slot = (slot + 1) & (table_.size() - 1))
            if (table_[slot].tag == tag && bits(values_[table_[slot].index]) == bits(value))
                return table_[slot].index;
        table_[slot] = {static_cast<Index>(values_.size()), tag};
        values_.push_back(value);
        return table_[slot].index;
    }

    /// Allocates memory for `count` values.
    void reserve(std::size_t count) {
        values_.reserve(count);
        if (2 * count > table_.size()) resize(std::bit_ceil(std::max<std::size_t>(2 * count, 1024)));
    }

    std::vector<Value>& values() { return values_; }
    const std::vector<Value>& values() const { return values_; }

private:
    using Word = std::conditional_t<sizeof(typename Value::value_type) == 8, std::uint64_t, std::uint32_t>;
    using Bits = std::array<Word, sizeof(Value) / sizeof(Word)>;

    static Bits bits(const Value& value) { return std::bit_cast<Bits>(value); }

    static std::uint64_t hash(const Value& value) {
        std::uint64_t h = 0;
        for (const Word word : bits(value)) {
            h = (h ^ word) * 0x9E3779B97F4A7C15u;
            h ^= h >> 32;
        }
        return h;
    }

    void resize(std::size_t size) {
        table_.assign(size, {});
        for (std::size_t i = 0; i < values_.size(); ++i) {
            const std::uint64_t h = hash(values_[i]);
            std::size_t slot = h & (size - 1);
            while (table_[slot].index != no_index) slot = (slot + 1) & (size - 1);
            table_[slot] = {static_cast<Index>(i), static_cast<std::uint32_t>(h >> 32)};
        }
    }

    struct Slot {
        Index index = no_index;
        std::uint32_t tag = 0;  ///< upper half of the hash; most comparisons of unequal values stop here
    };

    std::vector<Value> values_;
    std::vector<Slot> table_;
};

}  // namespace faqem::detail
