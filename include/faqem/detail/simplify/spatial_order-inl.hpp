#pragma once

#include "faqem/detail/simplify/spatial_order.hpp"
#include "faqem/export.hpp"

#include <algorithm>
#include <cstdint>
#include <utility>

#include "faqem/detail/base/morton.hpp"

FAQEM_NAMESPACE_BEGIN
namespace detail {

using engine::Vector3;

/// The referenced vertices in Morton order.
inline std::vector<Index> vertices_in_morton_order(const std::vector<Vector3>& positions,
                                                   const std::vector<Triangle>& triangles) {
    std::vector<std::uint8_t> used(positions.size(), 0);
    for (const Triangle& t : triangles) {
        if (t[0] == no_index) continue;
        for (const Index v : t) used[v] = 1;
    }
    Eigen::AlignedBox3d box;
    for (Index v = 0; v < used.size(); ++v) {
        if (used[v]) box.extend(positions[v]);
    }
    const double side = box.isEmpty() ? 0 : box.sizes().maxCoeff();
    const double per_side = side > 0 ? 1 / side : 0;
    std::vector<std::pair<std::uint64_t, Index>> keys;
    for (Index v = 0; v < used.size(); ++v) {
        if (used[v]) keys.emplace_back(morton<21>((positions[v] - box.min()) * per_side), v);
    }
    std::sort(keys.begin(), keys.end());
    std::vector<Index> order;
    order.reserve(keys.size());
    for (const auto& [key, v] : keys) order.push_back(v);
    return order;
}

/// The remaining faces, sorted by the smallest slot of their corners, then by index (counting sort).
inline std::vector<Index> faces_by_first_vertex(const std::vector<Triangle>& triangles,
                                                const std::vector<Index>& slot, std::size_t slots) {
    const auto first = [&](const Triangle& t) { return std::min({slot[t[0]], slot[t[1]], slot[t[2]]}); };
    std::vector<Index> offset(slots + 1, 0);
    for (const Triangle& t : triangles) {
        if (t[0] != no_index) ++offset[first(t) + 1];
    }
    for (std::size_t i = 1; i < offset.size(); ++i) offset[i] += offset[i - 1];
    std::vector<Index> order(offset.back());
    for (Index f = 0; f < triangles.size(); ++f) {
        if (triangles[f][0] != no_index) order[offset[first(triangles[f])]++] = f;
    }
    return order;
}

FAQEM_INLINE ReorderedMesh reorder(const PreprocessedMesh& prepared) {
    ReorderedMesh out;
    const std::vector<Vector3> positions = prepared.engine_positions();
    out.vertex = vertices_in_morton_order(positions, prepared.triangles);
    std::vector<Index> slot(positions.size(), no_index);
    for (Index i = 0; i < out.vertex.size(); ++i) slot[out.vertex[i]] = i;
    out.face = faces_by_first_vertex(prepared.triangles, slot, out.vertex.size());
    out.positions.reserve(out.vertex.size());
    for (const Index v : out.vertex) out.positions.push_back(positions[v]);
    out.triangles.reserve(out.face.size());
    for (const Index f : out.face) {
        const Triangle& t = prepared.triangles[f];
        out.triangles.push_back({slot[t[0]], slot[t[1]], slot[t[2]]});
    }
    return out;
}

}  // namespace detail
FAQEM_NAMESPACE_END
