#pragma once
/// \file
/// Which elements belong together, as pairs of them are joined.

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <vector>

#include "faqem/export.hpp"
#include "faqem/mesh.hpp"

FAQEM_NAMESPACE_BEGIN
namespace engine {

/// Disjoint sets of 0 .. size - 1, each known by its smallest member.
class UnionFind {
public:
    /// Every member is a set of its own.
    explicit UnionFind(std::size_t size = 0) : parent_(size) {
        std::iota(parent_.begin(), parent_.end(), Index{0});
    }

    /// One more, alone; returns it.
    Index add() {
        parent_.push_back(static_cast<Index>(parent_.size()));
        return parent_.back();
    }

    /// The smallest member of v's set. O(log size) amortised
    Index find(Index v) {
        while (parent_[v] != v) v = parent_[v] = parent_[parent_[v]];
        return v;
    }

    /// The sets of a and b become one.
    void unite(Index a, Index b) {
        a = find(a), b = find(b);
        parent_[std::max(a, b)] = std::min(a, b);
    }

private:
    std::vector<Index> parent_;
};

}  // namespace engine
FAQEM_NAMESPACE_END
