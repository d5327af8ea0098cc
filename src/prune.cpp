#include "prune.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace faqem::detail {

namespace {

constexpr Triangle no_face = {no_index, no_index, no_index};

struct Box {
    Vec3 low, high;
    Box() {
        low.fill(std::numeric_limits<double>::infinity());
        high.fill(-std::numeric_limits<double>::infinity());
    }
    void extend(const Vec3& p) {
        for (std::size_t i = 0; i < 3; ++i) {
            low[i] = std::min(low[i], p[i]);
            high[i] = std::max(high[i], p[i]);
        }
    }
    // Halves are taken first, so that 1e308 does not overflow. \pre not empty
    double half_diagonal() const {
        return std::hypot(0.5 * high[0] - 0.5 * low[0], 0.5 * high[1] - 0.5 * low[1],
                          0.5 * high[2] - 0.5 * low[2]);
    }
};

// The vertices joined by faces, each set under its smallest one.
class Joined {
public:
    explicit Joined(std::size_t vertices) : parent_(vertices) {
        std::iota(parent_.begin(), parent_.end(), Index{0});
    }
    Index root(Index v) {
        while (parent_[v] != v) v = parent_[v] = parent_[parent_[v]];
        return v;
    }
    void join(Index a, Index b) {
        a = root(a), b = root(b);
        parent_[std::max(a, b)] = std::min(a, b);
    }

private:
    std::vector<Index> parent_;
};

}  // namespace

Pruned prune(std::span<const Vec3> positions, std::span<const std::uint8_t> locked, const Length& size,
             std::vector<Triangle>& triangles) {
    Joined joined(positions.size());
    Box all;
    for (const Triangle& t : triangles) {
        if (t == no_face) continue;
        joined.join(t[0], t[1]);
        joined.join(t[0], t[2]);
        for (const Index v : t) all.extend(positions[v]);
    }
    // By root, those that have faces.
    std::vector<Box> box(positions.size());
    std::vector<std::uint8_t> stays(positions.size(), 0);
    for (const Triangle& t : triangles) {
        if (t == no_face) continue;
        const Index root = joined.root(t[0]);
        for (const Index v : t) {
            box[root].extend(positions[v]);
            if (!locked.empty() && locked[v]) stays[root] = 1;
        }
    }
    const double unit = size.unit == Length::Unit::model ? 0.5 : all.half_diagonal();
    const double least = size.value * unit;
    Index largest = no_index;
    for (const Triangle& t : triangles) {
        if (t == no_face) continue;
        const Index root = joined.root(t[0]);
        if (largest == no_index || box[root].half_diagonal() > box[largest].half_diagonal()) largest = root;
    }
    Pruned pruned;
    std::vector<std::uint8_t> counted(positions.size(), 0);
    for (Index f = 0; f < triangles.size(); ++f) {
        if (triangles[f] == no_face) continue;
        const Index root = joined.root(triangles[f][0]);
        if (root == largest || stays[root] || !(box[root].half_diagonal() < least)) continue;
        pruned.faces.push_back({f, triangles[f]});
        triangles[f] = no_face;
        pruned.components += counted[root] == 0;
        counted[root] = 1;
    }
    return pruned;
}

}  // namespace faqem::detail
