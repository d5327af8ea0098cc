#pragma once

#include "faqem/detail/geometry/triangle.hpp"
#include "faqem/detail/simplify/build_result.hpp"

#include <algorithm>
#include <string>
#include <utility>

FAQEM_DETAIL_BEGIN

FAQEM_INLINE std::vector<Index> build_result(const MeshView& mesh, const PreprocessedMesh& prepared,
                                             const ReorderedMesh& reordered,
                                             const engine::CollapseMesh& collapse_mesh,
                                             const engine::Wedges& wedges,
                                             std::span<const Index> source_vertices, SimplifyResult& result) {
    std::vector<Index> slots;
    std::vector<Vec3> position(collapse_mesh.vertex_slots());
    for (Index v = 0; v < position.size(); ++v) {
        const Index at = source_vertices[v];
        position[v] = at != no_index ? prepared.positions[at] : prepared.to_model(collapse_mesh.position(v));
    }
    std::vector<Index> slot_of_face(mesh.triangles.size(), no_index);
    std::vector<Index> slot_of_vertex(prepared.positions.size(), no_index);
    for (Index f = 0; f < collapse_mesh.face_slots(); ++f) {
        if (!collapse_mesh.is_alive(f)) continue;
        const Triangle& t = collapse_mesh.triangle(f);
        if (has_no_area(position[t[0]], position[t[1]], position[t[2]])) {
            ++result.report.faces_dropped;
            continue;
        }
        for (const Index v : t) slot_of_vertex[reordered.vertex[v]] = v;
        slot_of_face[reordered.face[f]] = f;
    }
    TriangleMesh& out = result.mesh;
    std::vector<Index> vertex(collapse_mesh.vertex_slots(), no_index);
    for (Index v = 0; v < slot_of_vertex.size(); ++v) {
        const Index slot = slot_of_vertex[v];
        if (slot == no_index) continue;
        vertex[slot] = static_cast<Index>(out.positions.size());
        out.positions.push_back(position[slot]);
        result.vertex_origin.push_back(prepared.vertex_origin[v]);
        slots.push_back(slot);
    }
    for (Index f = 0; f < slot_of_face.size(); ++f) {
        const Index slot = slot_of_face[f];
        if (slot == no_index) continue;
        const Triangle& t = collapse_mesh.triangle(slot);
        result.face_origin.push_back(f);
        out.triangles.push_back({vertex[t[0]], vertex[t[1]], vertex[t[2]]});
        if (!mesh.face_groups.empty()) out.face_groups.push_back(mesh.face_groups[f]);
        for (unsigned corner = 0; corner < 3 && !wedges.empty(); ++corner) {
            const float* values = wedges.values(slot, corner);
            out.attributes.values.insert(out.attributes.values.end(), values, values + wedges.width());
        }
    }
    out.attributes.width = wedges.width();
    return slots;
}

// A vertex that has exactly the position of an original vertex gets that position in model units, without
// rounding. This is consistent with build_result() for every level of a chain.
FAQEM_INLINE void to_model_units(const PreprocessedMesh& prepared, std::vector<Collapse>& collapses) {
    std::vector<Vector3> at = prepared.engine_positions();
    std::vector<Index> place = engine::all_indices(at.size());
    at.reserve(at.size() + collapses.size());
    place.reserve(at.capacity());
    for (Collapse& collapse : collapses) {
        const Vector3 to = to_eigen(collapse.position);
        Index original = no_index;
        if (to == at[collapse.first])
            original = place[collapse.first];
        else if (to == at[collapse.second])
            original = place[collapse.second];
        collapse.position = original != no_index ? prepared.positions[original] : prepared.to_model(to);
        at.push_back(to);
        place.push_back(original);
    }
}

FAQEM_INLINE void finish_history(const MeshView& mesh, const PruneResult& pruned, std::vector<Vec3> positions,
                                 std::vector<Triangle> triangles, SimplifyResult& result) {
    CollapseHistory& history = result.history;
    history.positions = std::move(positions);
    history.triangles = std::move(triangles);
    // Pruned faces are deleted before the first collapse.
    std::vector<DeletedFace> pruned_faces;
    for (const PrunedFace& face : pruned.faces) {
        history.triangles[face.face] = face.corners;
        pruned_faces.push_back({0, face.face});
    }
    history.deleted_faces.insert(history.deleted_faces.begin(), pruned_faces.begin(), pruned_faces.end());
    history.face_groups.assign(mesh.face_groups.begin(), mesh.face_groups.end());
    history.remaining_faces = result.face_origin;
}

FAQEM_INLINE bool revert_degenerate_faces(std::span<const Vec3> before, std::span<const Triangle> triangles,
                                          std::vector<Vec3>& now) {
    while (true) {
        bool is_good = true, is_changed = false;
        for (const Triangle& t : triangles) {
            if (!has_no_area(now[t[0]], now[t[1]], now[t[2]])) continue;
            is_good = false;
            for (const Index v : t) {
                is_changed = is_changed || now[v] != before[v];
                now[v] = before[v];
            }
        }
        if (is_good || !is_changed) return is_good;
    }
}

FAQEM_INLINE void record_fitting(std::span<const EdgeFlip> flips, SimplifyResult& result) {
    CollapseHistory& history = result.history;
    if (result.report.vertices_fitted > 0) history.final_positions = result.mesh.positions;
    for (const auto& [s, t] : flips) {
        history.patch_faces.insert(history.patch_faces.end(),
                                   {history.remaining_faces[s], history.remaining_faces[t]});
        history.patch_begin.push_back(history.patch_faces.size());
    }
}

FAQEM_INLINE void add_counts(const engine::LoopResult& loop_result, Report& report) {
    report.collapses += loop_result.collapses;
    for (std::size_t i = 0; i < refusal_kinds; ++i) report.refusals[i] += loop_result.refusals[i];
    for (std::size_t i = 0; i < rung_kinds; ++i) report.rungs[i] += loop_result.rungs[i];
    report.components_collapsed += loop_result.components_collapsed;
    report.components_deleted += loop_result.components_deleted;
}

FAQEM_INLINE void finish_report(const Options& options, const Settings& settings,
                                const PreprocessedMesh& prepared, SimplifyResult& result) {
    Report& report = result.report;
    const Weights& w = options.weights;
    if (settings.quadric_policy != Settings::QuadricPolicy::memory &&
        (w.area || w.boundary || w.normal || w.uv || w.plane_area))
        report.warnings.push_back("weights are ignored: preset " + std::string(name(options.preset)) +
                                  " does not use them (qem, paper and stmw do)");
    report.faces_out = result.mesh.triangles.size();
    report.vertices_out = result.mesh.positions.size();
    if (report.faces_dropped > 0)
        report.warnings.push_back(std::to_string(report.faces_dropped) +
                                  " degenerate or duplicate faces were removed");
    report.components_pruned = prepared.pruned.components;
    report.faces_pruned = prepared.pruned.faces.size();
    if (report.components_pruned > 0) {
        report.warnings.push_back(std::to_string(report.components_pruned) +
                                  " components smaller than the given size were pruned, with " +
                                  std::to_string(report.faces_pruned) + " faces");
    }
    if (report.components_deleted > 0)
        report.warnings.push_back(std::to_string(report.components_deleted) +
                                  " small components were deleted to reach the target");
    if (report.stop == StopReason::no_legal_collapse && !options.max_error) {
        const auto most = std::max_element(report.refusals.begin(), report.refusals.end());
        const auto refusal = static_cast<Refusal>(most - report.refusals.begin());
        report.warnings.push_back(
            "the target of " + std::to_string(report.target_faces) +
            " faces was not reached: all collapses that are left are refused, most of them as '" +
            std::string(name(refusal)) + "'");
    }
    if (report.faces_out == 0 && report.faces_in > 0 && report.stop != StopReason::cancelled)
        report.warnings.push_back("the result is empty: all remaining faces are degenerate");
}

FAQEM_DETAIL_END
