#pragma once
/// \file
/// Converts the input arrays to a mesh for the engine: checks, welding, removal of faces, scaling.

#include <span>
#include <vector>

#include "faqem/detail/base/vector.hpp"
#include "faqem/detail/simplify/presets.hpp"
#include "faqem/detail/simplify/prune_components.hpp"
#include "faqem/engine/mesh/collapse_mesh.hpp"
#include "faqem/engine/util/run_context.hpp"
#include "faqem/export.hpp"
#include "faqem/mesh.hpp"

FAQEM_DETAIL_BEGIN

/// A mesh that is ready for the engine. Vertices are welded; faces keep their input index.
struct PreprocessedMesh {
    std::vector<Vec3> positions;       ///< one per welded vertex, model units
    std::vector<Index> vertex_origin;  ///< one per welded vertex: the first input vertex welded into it
    std::vector<Index> welded;         ///< one per input vertex: its welded vertex
    std::vector<Triangle> triangles;   ///< one per input face, over welded vertices; three no_index: removed
    std::uint64_t dropped_faces = 0;   ///< removed faces with two equal corners, and removed duplicates
    PruneResult pruned;                ///< faces removed because their component is small
    Vec3 centre = {0, 0, 0};           ///< centre of the bounding box of referenced vertices, before pruning
    double scale = 1;                  ///< factor from model units to engine units

    /// Positions in engine units: (p - centre) * scale. O(n)
    std::vector<Vector3> engine_positions() const;
    /// Converts a position from engine units to model units.
    Vec3 to_model(const Vector3& p) const;

    /// Release the memory of an array that is no longer needed. O(1)
    void release_triangles() { std::vector<Triangle>().swap(triangles); }
    void release_welded() { std::vector<Index>().swap(welded); }
};

/// Checks the input, welds vertices, removes degenerate and duplicate faces, computes the scale and prunes
/// small components. Locked vertices keep their positions: vertices welded to them move there.
/// \param mesh      see simplify(); read only during the call
/// \param settings  weld, weld_distance, diagonal and prune are used
/// \param context   checked between the steps; exceptions pass through
/// \throws InputError  as simplify()
/// Complexity: O(n log n)
PreprocessedMesh preprocess(const MeshView& mesh, const Settings& settings,
                            const engine::RunContext& context = {});

/// Welds the vertices that triangles refer to, as engine::weld_within(). The others must not affect their positions.
/// \return per vertex, the index of its representative
FAQEM_EXPORT std::vector<Index> weld_referenced(const std::vector<Vec3>& positions,
                                                const TriangleView& triangles, double distance);

/// The input faces without those that Topology::prune removes; vertex indices are those of the input.
/// \throws as preprocess()
/// Complexity: O(n log n); O(n) without pruning
std::vector<Triangle> unpruned_triangles(const MeshView& mesh, const Options& options,
                                         const engine::RunContext& context = {});

/// Vertex locks after welding.
/// \param mesh      its vertex_locks are read
/// \param welded    PreprocessedMesh::welded
/// \param vertices  number of welded vertices
/// \return one per welded vertex; nonzero if a locked vertex was welded into it
std::vector<std::uint8_t> welded_locks(const MeshView& mesh, std::span<const Index> welded,
                                       std::size_t vertices);

FAQEM_DETAIL_END

#ifdef FAQEM_HEADER_ONLY
#include "faqem/detail/simplify/preprocess-inl.hpp"
#endif
