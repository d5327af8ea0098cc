#pragma once

#include "faqem/detail/simplify/prune_components.hpp"
#include "faqem/export.hpp"

#include "faqem/engine/mesh/union_find.hpp"
#include "faqem/engine/mesh/vector.hpp"

FAQEM_NAMESPACE_BEGIN
namespace detail {

inline constexpr Triangle no_face = {no_index, no_index, no_index};

using AlignedBox = Eigen::AlignedBox3d;

// Half of the diagonal. Coordinates are halved first, so that 1e308 does not overflow. \pre the box is not
// empty
inline double half_diagonal(const AlignedBox& box) {
    return (0.5 * box.max() - 0.5 * box.min()).stableNorm();
}

FAQEM_INLINE PruneResult prune(std::span<const Vec3> positions, std::span<const std::uint8_t> locked,
                               const Length& size, std::vector<Triangle>& triangles) {
    engine::UnionFind joined(positions.size());
    AlignedBox all;
    for (const Triangle& t : triangles) {
        if (t == no_face) continue;
        joined.unite(t[0], t[1]);
        joined.unite(t[0], t[2]);
        for (const Index v : t) all.extend(engine::to_eigen(positions[v]));
    }
    // Indexed by the root of a component.
    std::vector<AlignedBox> box(positions.size());
    std::vector<std::uint8_t> has_locked(positions.size(), 0);
    for (const Triangle& t : triangles) {
        if (t == no_face) continue;
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
        if (t == no_face) continue;
        const Index root = joined.find(t[0]);
        if (largest == no_index || half_diagonal(box[root]) > half_diagonal(box[largest])) largest = root;
    }
    PruneResult pruned;
    std::vector<std::uint8_t> counted(positions.size(), 0);
    for (Index f = 0; f < triangles.size(); ++f) {
        if (triangles[f] == no_face) continue;
        const Index root = joined.find(triangles[f][0]);
        if (root == largest || has_locked[root] || !(half_diagonal(box[root]) < least)) continue;
        pruned.faces.push_back({f, triangles[f]});
        triangles[f] = no_face;
        pruned.components += counted[root] == 0;
        counted[root] = 1;
    }
    return pruned;
}

}  // namespace detail
FAQEM_NAMESPACE_END
