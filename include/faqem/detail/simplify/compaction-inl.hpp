#pragma once

#include "faqem/detail/simplify/compaction.hpp"

#include <utility>

FAQEM_DETAIL_BEGIN

FAQEM_INLINE SlotTrace::SlotTrace(std::size_t slots)
    : next_(engine::all_indices(slots)), source_slots_(next_) {}

FAQEM_INLINE Index SlotTrace::root(Index slot) {
    Index end = slot;
    while (next_[end] != end) end = next_[end];
    while (next_[slot] != end) slot = std::exchange(next_[slot], end);
    return end;
}

FAQEM_INLINE CompactedMesh compacted(std::vector<Index> faces, std::vector<Triangle> triangles,
                                     std::span<const Vector3> positions, SlotTrace& trace) {
    CompactedMesh out;
    out.faces = std::move(faces);
    out.triangles = std::move(triangles);
    std::vector<Index> number(positions.size(), no_index);
    for (const Triangle& t : out.triangles)
        for (const Index v : t) number[v] = 0;
    for (Index v = 0; v < number.size(); ++v) {
        if (number[v] == no_index) continue;
        number[v] = static_cast<Index>(out.vertices.size());
        out.vertices.push_back(v);
        out.source_slots.push_back(trace.source_slots()[v]);
        out.positions.push_back(positions[v]);
    }
    for (Triangle& t : out.triangles)
        for (Index& v : t) v = number[v];
    out.vertex_map.reserve(number.size());
    for (Index v = 0; v < number.size(); ++v) {
        out.vertex_map.push_back(number[trace.root(v)]);
    }
    return out;
}

FAQEM_INLINE CompactedMesh compacted(const engine::CollapseMesh& mesh, SlotTrace& trace) {
    std::vector<Index> faces;
    std::vector<Triangle> triangles;
    for (Index f = 0; f < mesh.face_slots(); ++f) {
        if (!mesh.is_alive(f)) continue;
        faces.push_back(f);
        triangles.push_back(mesh.triangle(f));
    }
    std::vector<Vector3> positions;
    positions.reserve(mesh.vertex_slots());
    for (Index v = 0; v < mesh.vertex_slots(); ++v) positions.push_back(mesh.position(v));
    return compacted(std::move(faces), std::move(triangles), positions, trace);
}

FAQEM_DETAIL_END
