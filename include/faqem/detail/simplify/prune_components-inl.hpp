#pragma once

#include "faqem/detail/simplify/prune_components.hpp"

#include <utility>

#include "faqem/engine/mesh/union_find.hpp"
#include "faqem/engine/mesh/vector.hpp"

FAQEM_DETAIL_BEGIN

// Half of the diagonal. Coordinates are halved first, so that 1e308 does not overflow. \pre the box is not
// empty
inline double half_diagonal(const Eigen::AlignedBox3d& box) {
    return (0.5 * box.max() - 0.5 * box.min()).stableNorm();
}

FAQEM_INLINE PruneResult prune(std::span<const Vec3> positions, std::span<const std::uint8_t> locked,
                               const Length& size, std::vector<Triangle>& triangles) {
    engine::UnionFind joined(positions.size());
    Eigen::AlignedBox3d all;
    for (const Triangle& t : triangles) {
        if (t == no_corners) continue;
        for (const Index v : t) joined.unite(t[0], v), all.extend(engine::to_eigen(positions[v]));
    }
    // Indexed by the root of a component.
    std::vector<Eigen::AlignedBox3d> box(positions.size());
    std::vector<std::uint8_t> has_locked(positions.size(), 0);
    for (const Triangle& t : triangles) {
        if (t == no_corners) continue;
        const Index root = joined.find(t[0]);
        for (const Index v : t) {
            box[root].extend(engine::to_eigen(positions[v]));
            if (!locked.empty() && locked[v]) has_locked[root] = 1;
        }
    }
    const double unit = size.unit == Length::Unit::model ? 0.5 : half_diagonal(all);
    const double least = size.value * unit;
    Index largest = no_index;
    for (const Triangle& t : triangles) {
        if (t == no_corners) continue;
        const Index root = joined.find(t[0]);
        if (largest == no_index || half_diagonal(box[root]) > half_diagonal(box[largest])) largest = root;
    }
    PruneResult pruned;
    std::vector<std::uint8_t> counted(positions.size(), 0);
    for (Index f = 0; f < triangles.size(); ++f) {
        if (triangles[f] == no_corners) continue;
        const Index root = joined.find(triangles[f][0]);
        if (root == largest || has_locked[root] || !(half_diagonal(box[root]) < least)) continue;
        pruned.faces.push_back({f, triangles[f]});
        triangles[f] = no_corners;
        pruned.components += std::exchange(counted[root], std::uint8_t{1}) == 0;
    }
    return pruned;
}

FAQEM_DETAIL_END
