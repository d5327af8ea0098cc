#pragma once

#include "faqem/export.hpp"
#include "faqem/detail/simplify/spatial_order.hpp"

#include <algorithm>
#include <cstdint>
#include <utility>

#include "faqem/detail/base/morton.hpp"

FAQEM_NAMESPACE_BEGIN
namespace detail {

using engine::Poll;
using engine::Vector3;

/// The used vertices in the order of the curve.
inline std::vector<Index> along_the_curve(const std::vector<Vector3>& positions,
                                   const std::vector<Triangle>& triangles, Poll poll) {
    std::vector<std::uint8_t> used(positions.size(), 0);
    for (const Triangle& t : triangles) {
        poll();
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
        poll();
        if (used[v]) keys.emplace_back(morton<21>((positions[v] - box.min()) * per_side), v);
    }
    std::sort(keys.begin(), keys.end(), engine::polled_less(poll));
    std::vector<Index> order;
    order.reserve(keys.size());
    for (const auto& [key, v] : keys) order.push_back(v);
    return order;
}

/// Numbers the faces by the smallest of their corners' slots, then by index: a counting sort.
inline std::vector<Index> by_first_slot(const std::vector<Triangle>& triangles, const std::vector<Index>& slot,
                                 std::size_t slots, Poll poll) {
    const auto first = [&](const Triangle& t) { return std::min({slot[t[0]], slot[t[1]], slot[t[2]]}); };
    std::vector<Index> place(slots + 1, 0);
    for (const Triangle& t : triangles) {
        if (t[0] != no_index) ++place[first(t) + 1];
    }
    for (std::size_t i = 1; i < place.size(); ++i) place[i] += place[i - 1];
    std::vector<Index> order(place.back());
    for (Index f = 0; f < triangles.size(); ++f) {
        poll();
        if (triangles[f][0] != no_index) order[place[first(triangles[f])]++] = f;
    }
    return order;
}

FAQEM_INLINE Arranged arrange(const Prepared& prepared, Poll poll) {
    Arranged out;
    const std::vector<Vector3> positions = prepared.engine_positions(poll);
    out.vertex = along_the_curve(positions, prepared.triangles, poll);
    std::vector<Index> slot(positions.size(), no_index);
    for (Index i = 0; i < out.vertex.size(); ++i) slot[out.vertex[i]] = i;
    out.face = by_first_slot(prepared.triangles, slot, out.vertex.size(), poll);
    out.positions.reserve(out.vertex.size());
    for (const Index v : out.vertex) out.positions.push_back(positions[v]);
    out.triangles.reserve(out.face.size());
    for (const Index f : out.face) {
        poll();
        const Triangle& t = prepared.triangles[f];
        out.triangles.push_back({slot[t[0]], slot[t[1]], slot[t[2]]});
    }
    return out;
}

}  // namespace detail
FAQEM_NAMESPACE_END
