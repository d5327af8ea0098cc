#pragma once
/// \file
/// Vertex fitting of a finished result (preset best).

#include <vector>

#include "faqem/detail/base/parallel.hpp"
#include "faqem/detail/fitting/vertex_fitting.hpp"
#include "faqem/detail/geometry/edge_flip.hpp"
#include "faqem/detail/simplify/build_result.hpp"
#include "faqem/detail/simplify/engine_run.hpp"
#include "faqem/engine/mesh/union_find.hpp"
#include "faqem/simplify.hpp"

FAQEM_DETAIL_BEGIN

/// The faces of the initial surface in connected components of which the result has a vertex: others would draw vertices
/// to their places.
/// \param slots  of the vertices of the result
/// Complexity: O(n)
inline std::vector<Triangle> faces_of_components_left(const RunState& state,
                                                      const std::vector<Index>& slots) {
    const MeshRef surface = state.initial_surface();
    engine::UnionFind joined(surface.positions.size());
    for (const Triangle& t : surface.triangles) joined.unite(t[0], t[1]), joined.unite(t[0], t[2]);
    std::vector<std::uint8_t> has_result(state.mesh().positions.size(), 0),
        is_left(surface.positions.size(), 0);
    for (const Index slot : slots) has_result[slot] = 1;
    for (Index v = 0; v < is_left.size(); ++v) {
        const Index slot = state.vertex_map()[v];
        if (slot != no_index && has_result[slot]) is_left[joined.find(v)] = 1;
    }
    std::vector<Triangle> faces(surface.triangles.begin(), surface.triangles.end());
    std::erase_if(faces, [&](const Triangle& t) { return !is_left[joined.find(t[0])]; });
    return faces;
}

/// Moves the vertices of a result closer to the original and flips edges where that reduces the distance.
/// Locked vertices, seams and group curves stay; with attributes no edge is flipped, since that would change
/// the attributes of the corners. Fills the report's and the history's records of it.
/// \param state              has the initial surface
/// \param prepared           converts to model units
/// \param min_normal_cosine  between a face's normal before and after
/// \param input              of the engine that made the result
/// \param slots              vertex of `input` for each vertex of the result
/// \param result             changed in place
/// \throws whatever the check of `context` throws
/// Complexity: O(n log n) per iteration
inline void fit_result(const RunState& state, const PreprocessedMesh& prepared, double min_normal_cosine,
                       const EngineInput& input, const std::vector<Index>& slots, const RunContext& context,
                       SimplifyResult& result) {
    std::vector<Vector3> now;
    std::vector<std::uint8_t> fixed;
    for (const Index v : slots) {
        now.push_back(input.collapse_mesh.position(v));
        const bool is_seam = !input.wedges.empty() && input.wedges.is_seam(input.collapse_mesh, v);
        fixed.push_back(input.locked[v] || is_seam || input.curves.has_vertex(v));
    }
    TriangleMesh& mesh = result.mesh;
    std::vector<Vec3> moved = mesh.positions;
    std::vector<Triangle> triangles = mesh.triangles;
    const MeshRef simplified{now, mesh.triangles};
    // Edge flips would change the attributes of the corners.
    const EdgeFlips flips = input.wedges.empty() ? EdgeFlips::on : EdgeFlips::off;
    const std::vector<Triangle> left = faces_of_components_left(state, slots);
    const FittingResult fitted = fit_vertices({state.initial_surface().positions, left}, simplified, fixed,
                                              min_normal_cosine, flips, mesh.face_groups, context);
    for (std::size_t v = 0; v < now.size(); ++v) {
        if (fitted.positions[v] == now[v]) continue;
        moved[v] = prepared.to_model(fitted.positions[v]);
    }
    for (const auto& [s, t] : fitted.flips) flip_edge(triangles[s], triangles[t]);
    if (!revert_degenerate_faces(mesh.positions, triangles, moved)) return;
    for (std::size_t v = 0; v < now.size(); ++v)
        result.report.vertices_fitted += moved[v] != mesh.positions[v];
    mesh.positions = std::move(moved);
    mesh.triangles = std::move(triangles);
    result.report.edges_flipped = fitted.flips.size();
    if (!result.history.empty()) record_fitting(fitted.flips, result);
}

FAQEM_DETAIL_END
