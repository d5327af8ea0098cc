#pragma once
/// \file
/// Simplification with a custom metric in one call.

#include <string>
#include <vector>

#include "faqem/engine/engine.hpp"
#include "faqem/engine/mesh/weld.hpp"
#include "faqem/error.hpp"
#include "faqem/export.hpp"

FAQEM_ENGINE_BEGIN

/// Result of simplify_with().
struct CustomResult {
    TriangleMesh mesh;                 ///< positions and triangles; no groups and no attributes
    std::vector<Index> vertex_origin;  ///< per vertex of `mesh`: an input vertex merged into it
    std::vector<Index> face_origin;    ///< per face of `mesh`: its index in the input
    LoopResult loop;                   ///< counts and stop reason
};

namespace simplify_with_detail {

inline void check(const MeshView& mesh) {
    if (!(mesh.positions.size() < no_index)) throw InputError("positions: more than 2^32 - 2 vertices");
    if (mesh.triangles.size() > max_faces) throw InputError("triangles: more than 715827880 faces");
    if (!mesh.vertex_locks.empty() && mesh.vertex_locks.size() != mesh.positions.size())
        throw InputError("vertex_locks: needs one entry per vertex or none");
    for (std::size_t v = 0; v < mesh.positions.size(); ++v)
        if (!to_eigen(mesh.positions[v]).allFinite())
            throw InputError("vertex " + std::to_string(v) + ": position is not finite");
    for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
        for (const Index v : mesh.triangles[f])
            if (!(v < mesh.positions.size()))
                throw InputError("face " + std::to_string(f) + ": vertex index out of range");
    }
}

// Replaces each corner by its representative. Faces with two equal corners get three times no_index.
inline std::vector<Triangle> welded_faces(const MeshView& mesh, const std::vector<Index>& representative) {
    std::vector<Triangle> triangles(mesh.triangles.size());
    for (std::size_t f = 0; f < triangles.size(); ++f) {
        Triangle t = mesh.triangles[f];
        for (Index& v : t) v = representative[v];
        if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) t = {no_index, no_index, no_index};
        triangles[f] = t;
    }
    return triangles;
}

inline void build_result(const CollapseMesh& collapse_mesh, CustomResult& result) {
    std::vector<Index> number(collapse_mesh.vertex_slots(), no_index);
    for (Index v = 0; v < collapse_mesh.vertex_slots(); ++v) {
        if (collapse_mesh.degree(v) == 0) continue;
        number[v] = static_cast<Index>(result.mesh.positions.size());
        result.mesh.positions.push_back(to_array(collapse_mesh.position(v)));
        result.vertex_origin.push_back(v);
    }
    for (Index f = 0; f < collapse_mesh.face_slots(); ++f) {
        if (!collapse_mesh.is_alive(f)) continue;
        const Triangle& t = collapse_mesh.triangle(f);
        result.mesh.triangles.push_back({number[t[0]], number[t[1]], number[t[2]]});
        result.face_origin.push_back(f);
    }
}

}  // namespace simplify_with_detail

/// Simplifies a mesh with a custom metric: welds vertices at equal positions, then collapses pairs in the
/// order of their cost. Coordinates are not scaled; a metric whose parameters depend on the size of the
/// model must adapt them. Runs on the calling thread.
/// \tparam Metric  CustomMetric, or another CollapseMetric
/// \tparam Queue   HeapQueue, or another CollapseQueue
/// \param mesh     any triangle soup; positions, triangles and vertex_locks are used. Not modified
/// \param metric   determines the cost of a collapse and the new position
/// \param options  see LoopOptions; lengths are in model units
/// \return the simplified mesh; vertices and faces are in the order of the input
/// \throws InputError if an index is out of range, a position is not finite, an array has the wrong length
///     or the mesh has too many elements
/// \throws whatever `options.progress` throws
/// O(n log n) in the number of faces, for bounded valence and HeapQueue.
template <CollapseMetric Metric, CollapseQueue Queue = HeapQueue>
CustomResult simplify_with(const MeshView& mesh, Metric metric, const LoopOptions& options) {
    simplify_with_detail::check(mesh);
    std::vector<Vec3> positions(mesh.positions.size());
    for (std::size_t v = 0; v < positions.size(); ++v) positions[v] = mesh.positions[v];
    const std::vector<Index> representative = weld_exact(positions);
    std::vector<std::uint8_t> locked(positions.size(), 0);
    for (std::size_t v = 0; v < mesh.vertex_locks.size(); ++v)
        locked[representative[v]] |= mesh.vertex_locks[v] != 0;
    std::vector<Vector3> points;
    points.reserve(positions.size());
    for (const Vec3& p : positions) points.push_back(to_eigen(p));

    CollapseMesh collapse_mesh(points, simplify_with_detail::welded_faces(mesh, representative));
    PairTable pairs(collapse_mesh, {});
    Wedges wedges;
    NoRecorder recorder;
    CustomResult result;
    Engine<Metric, Queue, NoRecorder> engine(collapse_mesh, pairs, wedges, locked, metric, recorder);
    result.loop = engine.run(options);
    simplify_with_detail::build_result(collapse_mesh, result);
    return result;
}

FAQEM_ENGINE_END
