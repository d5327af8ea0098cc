#pragma once
/// \file
/// Numbers for different values, in the order in which they come first.

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <vector>

#include "faqem/mesh.hpp"

namespace faqem::detail {

/// A hash table with open addressing, whose results do not depend on the hash. Values are equal when their
/// bits are. \tparam Value  std::array of numbers of 4 or 8 bytes
template <class Value>
class ValueNumbers {
public:
    /// The number of a value, new or old. The caller sees to it that there are fewer than no_index.
    Index number(const Value& value) {
        if (2 * (values_.size() + 1) > table_.size()) grow();
        std::size_t slot = hash(value) & (table_.size() - 1);
        for (; table_[slot] != no_index; slot = (slot + 1) & (table_.size() - 1))
            if (bits(values_[table_[slot]]) == bits(value)) return table_[slot];
        table_[slot] = static_cast<Index>(values_.size());
        values_.push_back(value);
        return table_[slot];
    }

    std::vector<Value>& values() { return values_; }
    const std::vector<Value>& values() const { return values_; }

private:
    using Word = std::conditional_t<sizeof(typename Value::value_type) == 8, std::uint64_t, std::uint32_t>;
    using Bits = std::array<Word, sizeof(Value) / sizeof(Word)>;

    static Bits bits(const Value& value) { return std::bit_cast<Bits>(value); }

    static std::size_t hash(const Value& value) {
        std::uint64_t h = 0;
        for (const Word word : bits(value)) {
            h = (h ^ word) * 0x9E3779B97F4A7C15u;
            h ^= h >> 32;
        }
        return static_cast<std::size_t>(h);
    }

    void grow() {
        table_.assign(table_.empty() ? 1024 : 2 * table_.size(), no_index);
        for (std::size_t i = 0; i < values_.size(); ++i) {
            std::size_t slot = hash(values_[i]) & (table_.size() - 1);
            while (table_[slot] != no_index) slot = (slot + 1) & (table_.size() - 1);
            table_[slot] = static_cast<Index>(i);
        }
    }

    std::vector<Value> values_;
    std::vector<Index> table_;
};

}  // namespace faqem::detail
