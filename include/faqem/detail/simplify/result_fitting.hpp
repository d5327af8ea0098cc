#pragma once
/// \file
/// Vertex fitting of a finished result (preset best).

#include <vector>

#include "faqem/detail/base/parallel.hpp"
#include "faqem/detail/fitting/vertex_fitting.hpp"
#include "faqem/detail/geometry/edge_flip.hpp"
#include "faqem/detail/simplify/build_result.hpp"
#include "faqem/detail/simplify/engine_run.hpp"
#include "faqem/simplify.hpp"

FAQEM_NAMESPACE_BEGIN
namespace detail {

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
    const FittingResult fitted = fit_vertices(state.initial_surface(), simplified, fixed, min_normal_cosine,
                                              flips, mesh.face_groups, context);
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

}  // namespace detail
FAQEM_NAMESPACE_END
