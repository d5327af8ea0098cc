#pragma once
/// \file
/// Disjoint-set forest (union-find).

#include <algorithm>
#include <cstddef>
#include <vector>

#include "faqem/engine/mesh/index_lists.hpp"
#include "faqem/export.hpp"

FAQEM_ENGINE_BEGIN

/// Disjoint sets of the numbers 0 .. size - 1. Each set is represented by its smallest member.
class UnionFind {
public:
    /// Creates `size` sets of one member each. O(size)
    explicit UnionFind(std::size_t size = 0) : parent_(all_indices(size)) {}

    /// Adds a set with one new member and returns that member. Amortised O(1)
    Index add() {
        parent_.push_back(static_cast<Index>(parent_.size()));
        return parent_.back();
    }

    /// Smallest member of the set that contains v; shortens the path to it. O(log size) amortised
    Index find(Index v) {
        while (parent_[v] != v) v = parent_[v] = parent_[parent_[v]];
        return v;
    }

    /// Merges the sets that contain a and b. O(log size) amortised
    void unite(Index a, Index b) {
        a = find(a), b = find(b);
        parent_[std::max(a, b)] = std::min(a, b);
    }

private:
    std::vector<Index> parent_;
};

FAQEM_ENGINE_END
