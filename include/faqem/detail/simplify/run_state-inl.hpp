#pragma once

#include "faqem/detail/simplify/run_state.hpp"
#include "faqem/engine/tracking/tracked_metric.hpp"

#include <algorithm>
#include <cassert>
#include <utility>

FAQEM_DETAIL_BEGIN

// The values at the given slots; no_index, converted to T, where the slot is no_index.
template <class T>
std::vector<T> gather(const std::vector<T>& of, const std::vector<Index>& slots) {
    std::vector<T> result;
    result.reserve(slots.size());
    for (const Index slot : slots) result.push_back(slot == no_index ? static_cast<T>(no_index) : of[slot]);
    return result;
}

FAQEM_INLINE RunState::RunState(const PreprocessedMesh& prepared, const std::vector<std::uint8_t>& locked,
                                Boundary boundary, const engine::RunContext& context)
    : mesh_(reorder(prepared, context)), locked_(gather(locked, mesh_.vertex)) {
    links_ = link_corners(mesh_.triangles, mesh_.positions.size(), context);
    closed_ = closed_vertices(mesh_.triangles, links_, mesh_.positions.size());
    if (boundary != Boundary::locked) return;
    for (const auto& [a, b] : engine::find_boundary_edges(mesh_.triangles, mesh_.positions.size()))
        locked_[a] = locked_[b] = 1;
}

FAQEM_INLINE void RunState::find_planar_borders() {
    if (std::find(closed_.begin(), closed_.end(), 0) == closed_.end()) return;  // there is no border
    engine::PlanarBorderSearch search(mesh_.positions, mesh_.triangles);
    borders_ = original_ ? search.find(original_->boundary_edges())
                         : search.find(engine::find_boundary_edges(mesh_.triangles, mesh_.positions.size()));
}

FAQEM_INLINE std::optional<CompactedMesh> RunState::simplify_in_rounds(
    std::size_t target, double distance_weight, std::span<const Index> groups, Recording patches,
    const engine::RunContext& context, RoundSteps& found) {
    if (mesh_.positions.size() < min_vertices_of_rounds) return {};
    if (!original_)
        return detail::simplify_in_rounds(
            {mesh_.positions, mesh_.triangles, links_, locked_, groups, &borders_},
            faces_after_rounds(target, target / 4), patches, context, found);
    std::vector<engine::Vector3> positions = mesh_.positions;
    std::vector<Triangle> triangles = mesh_.triangles;
    const RoundTracking tracking{&*original_, vertex_map_,
                                 engine::TrackedMetric::tracking_start_ratio * target, distance_weight};
    return detail::simplify_in_rounds(
        {positions, triangles, links_, locked_, groups, &borders_, Recording::on, &tracking},
        faces_after_rounds(target, target / 20), patches, context, found);
}

FAQEM_INLINE void RunState::advance_to(CompactedMesh&& compacted) {
    if (!borders_.at.empty()) {
        std::vector<Index> at(compacted.vertices.size(), no_index);
        for (Index v = 0; v < borders_.at.size(); ++v) {
            const Index to = compacted.vertex_map[v];
            if (to != no_index) at[to] = engine::PlanarBorders::merged(at[to], borders_.at[v]);
        }
        borders_.at = std::move(at);
    }
    source_vertices_ = gather(source_vertices(), compacted.source_slots);
    vertex_map_ = gather(compacted.vertex_map, vertex_map_);
    bound_faces_ = std::move(compacted.bound_faces);
    locked_ = gather(locked_, compacted.vertices);
    closed_ = gather(closed_, compacted.vertices);
    ReorderedMesh less{gather(mesh_.vertex, compacted.vertices), gather(mesh_.face, compacted.faces),
                       std::move(compacted.positions), std::move(compacted.triangles)};
    std::swap(mesh_, less);
    if (!keeps_initial_surface_ || !initial_positions_.empty()) return;
    initial_positions_ = std::move(less.positions);
    initial_triangles_ = std::move(less.triangles);
}

FAQEM_INLINE std::vector<Index> RunState::source_vertices_of(const std::vector<Index>& slots) const {
    return gather(source_vertices(), slots);
}

FAQEM_INLINE MeshRef RunState::initial_surface() const {
    assert(keeps_initial_surface_);
    if (initial_positions_.empty()) return {mesh_.positions, mesh_.triangles};
    return {initial_positions_, initial_triangles_};
}

FAQEM_DETAIL_END
