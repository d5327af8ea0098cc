#pragma once

#include "faqem/detail/simplify/spatial_order.hpp"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <utility>

#include "faqem/detail/base/buckets.hpp"
#include "faqem/detail/base/morton.hpp"
#include "faqem/detail/base/parallel.hpp"

FAQEM_DETAIL_BEGIN

/// The referenced vertices in Morton order.
inline std::vector<Index> vertices_in_morton_order(const std::vector<Vector3>& positions,
                                                   const std::vector<Triangle>& triangles,
                                                   const RunContext& context) {
    std::vector<std::uint8_t> used(positions.size(), 0);
    for (const Triangle& t : triangles) {
        if (t[0] == no_index) continue;
        for (const Index v : t) used[v] = 1;
    }
    Eigen::AlignedBox3d box;
    for (Index v = 0; v < used.size(); ++v)
        if (used[v]) box.extend(positions[v]);
    const double side = box.isEmpty() ? 0 : box.sizes().maxCoeff();
    const double per_side = side > 0 ? 1 / side : 0;
    std::vector<std::uint64_t> code(positions.size());
    parallel_each(code.size(), elements_per_block, context,
                  [&](std::size_t v) { code[v] = morton<21>((positions[v] - box.min()) * per_side); });
    // The vertices with the same first bits are sorted side by side.
    const auto first_bits = std::min(static_cast<unsigned>(std::bit_width(code.size() / 64)), 15u);
    Buckets<std::pair<std::uint64_t, Index>> keys(std::size_t{1} << first_bits, [&](auto&& put) {
        for (Index v = 0; v < used.size(); ++v)
            if (used[v]) put(code[v] >> (63 - first_bits), {code[v], v});
    });
    std::vector<Index> order(keys.items().size());
    parallel_blocks(keys.begin().size() - 1, 256, context, [&](std::size_t first, std::size_t end) {
        const auto at = [&](std::size_t b) {
            return keys.items().begin() + static_cast<std::ptrdiff_t>(keys.begin()[b]);
        };
        for (std::size_t b = first; b < end; ++b) std::sort(at(b), at(b + 1));
        for (std::size_t i = keys.begin()[first]; i < keys.begin()[end]; ++i)
            order[i] = keys.items()[i].second;
    });
    return order;
}

FAQEM_INLINE ReorderedMesh reorder(const PreprocessedMesh& prepared, const RunContext& context) {
    ReorderedMesh out;
    const std::vector<Triangle>& triangles = prepared.triangles;
    std::vector<Vector3> positions = prepared.engine_positions();
    out.vertex = vertices_in_morton_order(positions, triangles, context);
    std::vector<Index> slot(positions.size(), no_index);
    out.positions.resize(out.vertex.size());
    parallel_each(out.vertex.size(), elements_per_block, context, [&](std::size_t i) {
        slot[out.vertex[i]] = static_cast<Index>(i);
        out.positions[i] = positions[out.vertex[i]];
    });
    std::vector<Vector3>().swap(positions);
    // Faces are sorted by the smallest slot of their corners, then by index.
    std::vector<Index> first_slot(triangles.size());
    parallel_each(triangles.size(), elements_per_block, context, [&](std::size_t f) {
        const Triangle& t = triangles[f];
        first_slot[f] = t[0] == no_index ? no_index : std::min({slot[t[0]], slot[t[1]], slot[t[2]]});
    });
    out.face = std::move(Buckets<Index>(out.vertex.size(), [&](auto&& put) {
                             for (Index f = 0; f < first_slot.size(); ++f)
                                 if (first_slot[f] != no_index) put(first_slot[f], f);
                         }).items());
    out.triangles.resize(out.face.size());
    parallel_each(out.face.size(), elements_per_block, context, [&](std::size_t i) {
        const Triangle& t = triangles[out.face[i]];
        out.triangles[i] = {slot[t[0]], slot[t[1]], slot[t[2]]};
    });
    return out;
}

FAQEM_DETAIL_END
