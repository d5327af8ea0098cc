#pragma once
/// \file
/// From the caller's arrays to the engine's complex: checks, weld, repair, scale.

#include <span>
#include <vector>

#include "faqem/detail/simplify/presets.hpp"
#include "faqem/detail/simplify/prune_components.hpp"
#include "faqem/engine/mesh/collapse_mesh.hpp"
#include "faqem/export.hpp"
#include "faqem/mesh.hpp"

FAQEM_NAMESPACE_BEGIN
namespace detail {

/// A mesh made ready for the engine. Vertices are the welded ones, faces keep their input index.
struct PreprocessedMesh {
    std::vector<Vec3> positions;       ///< welded vertices, model units
    std::vector<Index> vertex_origin;  ///< welded vertex -> first input vertex there
    std::vector<Index> welded;         ///< input vertex -> welded vertex
    std::vector<Triangle> triangles;   ///< per input face; three no_index where dropped
    std::uint64_t dropped_faces = 0;   ///< with two equal corners, or doubles of an earlier face
    PruneResult pruned;                ///< dropped because their component is small
    Vec3 centre = {0, 0, 0};           ///< of the box of the used vertices, pruned too
    double scale = 1;                  ///< model units to engine units

    /// Engine units: (p - centre) * scale.
    std::vector<engine::Vector3> engine_positions(engine::CancellationCheck check_cancelled = {}) const;
    /// Back to model units.
    Vec3 to_model(const engine::Vector3& p) const;

    /// Give back the memory of what is not needed any more. O(1)
    void release_triangles() { std::vector<Triangle>().swap(triangles); }
    void release_welded() { std::vector<Index>().swap(welded); }
};

/// \throws InputError  see simplify(); and what the poll throws
PreprocessedMesh preprocess(const MeshView& mesh, const Settings& settings,
                            engine::CancellationCheck check_cancelled = {});

/// The input's faces less those that are pruned.
/// \throws as prepare()
std::vector<Triangle> unpruned_triangles(const MeshView& mesh, const Options& options,
                                         engine::CancellationCheck check_cancelled = {});

/// One per welded vertex: nonzero where a locked vertex went into it.
std::vector<std::uint8_t> welded_locks(const MeshView& mesh, std::span<const Index> welded,
                                       std::size_t vertices);

/// Is the triangle too flat to have a normal: height at most 1e-12 of its longest edge?
FAQEM_EXPORT bool has_no_area(const Vec3& a, const Vec3& b, const Vec3& c);

}  // namespace detail
FAQEM_NAMESPACE_END

#ifdef FAQEM_HEADER_ONLY
#include "faqem/detail/simplify/preprocess-inl.hpp"
#endif
