#pragma once

#include "faqem/detail/mapping/replay.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "faqem/detail/geometry/edge_flip.hpp"
#include "faqem/detail/geometry/halfedges.hpp"
#include "faqem/engine/mesh/union_find.hpp"

FAQEM_DETAIL_BEGIN

// Numbers the connected components of a patch 0, 1, ... (at most 255) in the order of their first faces,
// see ReplayTables::patch_component.
// corners: per face of the patch; surface_patch(e): surface patch of face e of the patch
template <class PatchId>
void label_components(std::span<const Triangle> corners, PatchId&& surface_patch,
                      std::span<std::uint8_t> labels) {
    engine::UnionFind joined(corners.size());
    for_each_edge(sorted_halfedges(corners), [&](std::span<const Halfedge> on) {
        for_each_connected_pair(
            on.size(), [&](std::size_t i) { return surface_patch(on[i].face); },
            [&](std::size_t i, std::size_t j) { joined.unite(on[i].face, on[j].face); });
    });
    std::uint8_t next = 0;
    for (Index e = 0; e < corners.size(); ++e) {
        const Index first = joined.find(e);  // <= e
        labels[e] = first == e ? next : labels[first];
        if (first == e && next < 255) ++next;
    }
}

inline double distance(const Vec3& a, const Vec3& b) {
    const double x = a[0] - b[0], y = a[1] - b[1], z = a[2] - b[2];
    return std::sqrt(x * x + y * y + z * z);
}

inline float mean_edge_length(const std::vector<Vec3>& positions, std::span<const Triangle> corners) {
    double sum = 0;
    for (const Triangle& t : corners)
        for (int c = 0; c < 3; ++c) sum += distance(positions[t[c]], positions[t[(c + 1) % 3]]);
    return corners.empty() ? 0.0f : static_cast<float>(sum / (3.0 * static_cast<double>(corners.size())));
}

inline std::vector<Vec3> version_positions(const CollapseHistory& history) {
    std::vector<Vec3> result = history.positions;
    result.reserve(result.size() + history.collapses.size());
    for (const Collapse& c : history.collapses) result.push_back(c.position);
    return result;
}

inline BoundingSphere bounding_sphere(const std::vector<Vec3>& positions, const Triangle& t) {
    constexpr float infinity = std::numeric_limits<float>::infinity();
    const Vec3 &a = positions[t[0]], &b = positions[t[1]], &c = positions[t[2]];
    BoundingSphere bound;
    Vec3 centre;
    for (std::size_t i = 0; i < 3; ++i) {
        const double middle = 0.5 * std::min({a[i], b[i], c[i]}) + 0.5 * std::max({a[i], b[i], c[i]});
        bound.centre[i] = static_cast<float>(middle);
        centre[i] = bound.centre[i];
        if (!std::isfinite(bound.centre[i])) return {{}, infinity};
    }
    const double radius = std::max({distance(a, centre), distance(b, centre), distance(c, centre)});
    bound.radius = std::nextafter(static_cast<float>(radius * (1 + 1e-12)), infinity);
    return bound;
}

// Replays the collapses and edge flips. Calls before(patch, entry, corners) for each entry before it is
// changed. Returns the final corner versions of all input faces.
template <class Before>
std::vector<Triangle> replay_forward(const CollapseHistory& history, Before&& before) {
    std::vector<Triangle> now = history.triangles;
    for (std::size_t k = 0; k < history.collapses.size(); ++k) {
        const Collapse& c = history.collapses[k];
        const Index made = static_cast<Index>(history.positions.size() + k);
        for (std::uint64_t e = history.patch_begin[k]; e < history.patch_begin[k + 1]; ++e) {
            Triangle& t = now[history.patch_faces[e]];
            before(k, e, t);
            for (Index& v : t)
                if (v == c.first || v == c.second) v = made;
        }
    }
    for (std::size_t k = history.collapses.size(); k < history.patch_count(); ++k) {
        const std::span<const Index> patch = history.patch(k);
        const std::uint64_t begin = history.patch_begin[k];
        for (std::size_t i = 0; i < 2; ++i) before(k, begin + i, now[patch[i]]);
        flip_edge(now[patch[0]], now[patch[1]]);
    }
    return now;
}

// Fills corner_versions and corner_positions. last: final corner versions of all input faces
inline void fill_simplified_faces(const CollapseHistory& history, const std::vector<Triangle>& last,
                                  ReplayTables& result) {
    std::vector<Vec3> final_positions = result.positions;
    for (std::size_t i = 0; i < history.remaining_versions.size(); ++i)
        final_positions[history.remaining_versions[i]] = history.final_position(i);
    for (const Index f : history.remaining_faces) {
        const Triangle& t = last[f];
        result.corner_versions.push_back(t);
        result.corner_positions.push_back(
            {final_positions[t[0]], final_positions[t[1]], final_positions[t[2]]});
    }
}

// ReplayTables::entry_begin
inline std::vector<std::uint64_t> entries_of_patches(const CollapseHistory& history) {
    const auto entries = [&](std::size_t k) {
        const std::uint64_t size = history.patch_begin[k + 1] - history.patch_begin[k];
        return size > max_entries_of_patch ? 0 : size;
    };
    std::uint64_t sum = 0;
    for (std::size_t k = 0; k < history.patch_count(); ++k) sum += entries(k);
    if (sum == history.patch_faces.size()) return {};
    std::vector<std::uint64_t> begin(1, 0);
    begin.reserve(history.patch_count() + 1);
    for (std::size_t k = 0; k < history.patch_count(); ++k) begin.push_back(begin.back() + entries(k));
    return begin;
}

FAQEM_INLINE ReplayTables replay_patches(const CollapseHistory& history) {
    ReplayTables result;
    result.positions = version_positions(history);
    result.entry_begin = entries_of_patches(history);
    const std::uint64_t entries = result.first_entry(history, history.patch_count());
    result.corners.resize(entries);
    result.previous.resize(entries);

    std::vector<Index> touched(history.triangles.size(), no_index);
    const std::vector<Triangle> last =
        replay_forward(history, [&](std::size_t k, std::uint64_t e, const Triangle& t) {
            Index& latest = touched[history.patch_faces[e]];
            if (result.has_entries(history, k)) {
                const std::uint64_t entry = result.first_entry(history, k) + e - history.patch_begin[k];
                result.corners[entry] = t;
                result.previous[entry] = latest;
            }
            latest = static_cast<Index>(k);
        });
    fill_simplified_faces(history, last, result);
    for (Index f : history.remaining_faces) result.last_patches.push_back(touched[f]);
    return result;
}

FAQEM_INLINE void describe_patches(const CollapseHistory& history, std::span<const Index> surface_patches,
                                   const RunContext& context, ReplayTables& replay) {
    replay.bounds.resize(replay.corners.size());
    replay.patch_component.resize(replay.corners.size());
    replay.mean_edge.resize(history.patch_count());
    parallel_each(history.patch_count(), 1024, context, [&](std::size_t k) {
        const std::uint64_t begin = replay.first_entry(history, k),
                            size = replay.first_entry(history, k + 1) - begin;
        const std::span<const Triangle> corners = std::span(replay.corners).subspan(begin, size);
        for (std::size_t e = 0; e < size; ++e)
            replay.bounds[begin + e] = bounding_sphere(replay.positions, corners[e]);
        const auto surface_patch = [&](std::size_t e) { return surface_patches[history.patch(k)[e]]; };
        label_components(corners, surface_patch, std::span(replay.patch_component).subspan(begin, size));
        replay.mean_edge[k] = mean_edge_length(replay.positions, corners);
    });
}

FAQEM_DETAIL_END
