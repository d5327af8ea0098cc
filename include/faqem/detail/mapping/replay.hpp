#pragma once
/// \file
/// Tables for following a collapse history backwards, from the simplified mesh to the original.

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

/// Bounding sphere of a triangle: 16 bytes that often suffice to skip the triangle in a search.
struct BoundingSphere {
    std::array<float, 3> centre = {};
    float radius = 0;  ///< rounded up; infinite if the centre is not finite
};

/// Tables computed by replaying a history. An entry is an index into CollapseHistory::patch_faces; it stands
/// for one face of one patch, just before the collapse or edge flip of the patch.
struct ReplayTables {
    std::vector<Vec3> positions;  ///< positions of all versions, model units

    std::vector<Triangle> corners;       ///< per entry: versions of the three corners
    std::vector<BoundingSphere> bounds;  ///< per entry: bounding sphere of the triangle
    std::vector<Index> previous;  ///< per entry: last earlier patch that contains the face, or no_index
    /// Per entry: number of its connected component within the patch. Faces are connected across an edge if
    /// it has two faces, or two of their surface patch, see for_each_connected_pair().
    std::vector<std::uint8_t> patch_component;
    std::vector<float> mean_edge;  ///< per patch: mean edge length, model units

    std::vector<Triangle> kept_corners;               ///< per simplified face: versions of the corners
    std::vector<std::array<Vec3, 3>> kept_positions;  ///< per simplified face: final positions of the corners
    std::vector<Index> kept_last;  ///< per simplified face: last patch that contains it, or no_index

    /// Position of a point of the simplified mesh.
    /// \param face         face of the simplified mesh
    /// \param barycentric  weights of its three corners
    engine::Vector3 position_on(Index face, const Vec3& barycentric) const {
        engine::Vector3 p = engine::Vector3::Zero();
        for (std::size_t i = 0; i < 3; ++i) p += barycentric[i] * engine::to_eigen(kept_positions[face][i]);
        return p;
    }
};

/// Computes positions, kept_corners and kept_positions only, which are sufficient for LineageMap and
/// ClosestPointMap.
/// \param history  valid
/// \throws whatever `check_cancelled` throws
/// O(size of the history)
ReplayTables replay_vertices(const CollapseHistory& history, engine::CancellationCheck check_cancelled = {});

/// Computes all tables except those that describe_patches() adds.
/// \param history  valid
/// \throws whatever `check_cancelled` throws
/// O(size of the history) time; 37 bytes per patch face, including describe_patches()
ReplayTables replay_patches(const CollapseHistory& history, engine::CancellationCheck check_cancelled = {});

/// Computes bounds, patch_component and mean_edge.
/// \param surface_patches  per face of the original: number of its surface patch
/// \param replay           result of replay_patches(history), to which the tables are added
/// \throws whatever `workers.check_cancelled` throws
/// O(size of the history)
void describe_patches(const CollapseHistory& history, std::span<const Index> surface_patches, Workers workers,
                      ReplayTables& replay);

}  // namespace detail
FAQEM_NAMESPACE_END

#ifdef FAQEM_HEADER_ONLY
#include "faqem/detail/mapping/replay-inl.hpp"
#endif
