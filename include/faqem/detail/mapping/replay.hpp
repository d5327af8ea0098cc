#pragma once
/// \file
/// A collapse history made ready for walking backwards.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "faqem/detail/base/parallel.hpp"
#include "faqem/engine/mesh/vector.hpp"
#include "faqem/export.hpp"
#include "faqem/history.hpp"

FAQEM_NAMESPACE_BEGIN
namespace detail {

/// A sphere around a triangle: tells from 16 bytes whether a look at its corners is worth while.
struct BoundingSphere {
    std::array<float, 3> centre = {};
    float radius = 0;  ///< rounded up; infinite where the centre is not finite
};

/// What the walks read. "Entry" e is a place in CollapseHistory::patch_faces.
struct ReplayTables {
    std::vector<Vec3> positions;  ///< of all versions, originals first

    std::vector<Triangle>
        corners;  ///< per entry: corner versions of its face just before the collapse or flip
    std::vector<BoundingSphere> bounds;  ///< per entry: around those corners
    std::vector<Index> previous;         ///< per entry: the latest earlier patch that had its face
    std::vector<std::uint8_t>
        patch_component;  ///< per entry: component of its patch over edges with two faces, or two of a surface_patch
    std::vector<float> mean_edge;  ///< per patch: mean edge length

    std::vector<Triangle> kept_corners;               ///< per face of the small mesh: corner versions
    std::vector<std::array<Vec3, 3>> kept_positions;  ///< per face of the small mesh: where they are
    std::vector<Index> kept_last;  ///< per face of the small mesh: last patch that had it, or no_index

    /// Where a point of the small mesh is. \param barycentric  weights of the face's corners
    engine::Vector3 position_on(Index face, const Vec3& barycentric) const {
        engine::Vector3 p = engine::Vector3::Zero();
        for (std::size_t i = 0; i < 3; ++i) p += barycentric[i] * engine::to_eigen(kept_positions[face][i]);
        return p;
    }
};

/// What is needed by the walk over vertices: positions, kept_corners and kept_positions. O(size of the
/// history)
/// \throws what the poll throws
ReplayTables replay_vertices(const CollapseHistory& history, engine::CancellationCheck check_cancelled = {});

/// Everything but what describe_patches() adds. O(size of the history) time, 37 bytes per patch face with it.
/// \throws what the poll throws
ReplayTables replay_patches(const CollapseHistory& history, engine::CancellationCheck check_cancelled = {});

/// Adds bounds, patch_component and mean_edge. O(size of the history)
/// \throws what the poll throws
/// \param surface_patches  of each face of the original
/// \param replay  of replay_patches(history)
void describe_patches(const CollapseHistory& history, std::span<const Index> surface_patches, Workers workers,
                      ReplayTables& replay);

}  // namespace detail
FAQEM_NAMESPACE_END

#ifdef FAQEM_HEADER_ONLY
#include "faqem/detail/mapping/replay-inl.hpp"
#endif
