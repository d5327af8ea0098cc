#pragma once
/// \file
/// Tables for following a collapse history backwards, from the simplified mesh to the original.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "faqem/detail/base/parallel.hpp"
#include "faqem/detail/base/vector.hpp"
#include "faqem/export.hpp"
#include "faqem/history.hpp"

FAQEM_DETAIL_BEGIN

/// Bounding sphere of a triangle: 16 bytes that often suffice to skip the triangle in a search.
struct BoundingSphere {
    std::array<float, 3> centre = {};
    float radius = 0;  ///< rounded up; infinite if the centre is not finite
};

/// Largest patch with entries in ReplayTables, about ten times the number of faces that a walk of
/// SuccessiveProjection usually visits. Larger patches end the walk. Without this limit, n faces at one vertex
/// or edge would have n * n / 2 entries.
inline constexpr std::uint64_t max_entries_of_patch = 2048;

/// Tables computed by replaying a history. An entry stands for one face of one patch, just before the collapse
/// or edge flip of the patch. The entries are in the order of CollapseHistory::patch_faces; patches of more
/// than max_entries_of_patch faces have none.
struct ReplayTables {
    std::vector<Vec3> positions;  ///< positions of all versions, model units

    /// Per patch: its first entry, and at the end the number of entries. Empty if all patches have entries;
    /// then an entry is an index into CollapseHistory::patch_faces.
    std::vector<std::uint64_t> entry_begin;

    std::vector<Triangle> corners;       ///< per entry: versions of the three corners
    std::vector<BoundingSphere> bounds;  ///< per entry: bounding sphere of the triangle
    std::vector<Index> previous;  ///< per entry: last earlier patch that contains the face, or no_index
    /// Per entry: number of its connected component within the patch. Faces are connected across an edge if
    /// it has two faces, or two of their surface patch, see for_each_connected_pair().
    std::vector<std::uint8_t> patch_component;
    std::vector<float> mean_edge;  ///< per patch: mean edge length, model units

    std::vector<Triangle> corner_versions;  ///< per simplified face: versions of the corners
    std::vector<std::array<Vec3, 3>>
        corner_positions;             ///< per simplified face: final positions of the corners
    std::vector<Index> last_patches;  ///< per simplified face: last patch that contains it, or no_index

    /// First entry of a patch; `patch` may be the number of patches. O(1)
    std::uint64_t first_entry(const CollapseHistory& history, std::size_t patch) const {
        return entry_begin.empty() ? history.patch_begin[patch] : entry_begin[patch];
    }
    /// Whether a patch has entries. O(1)
    bool has_entries(const CollapseHistory& history, std::size_t patch) const {
        return first_entry(history, patch) != first_entry(history, patch + 1);
    }
};

/// Computes all tables except those that describe_patches() adds.
/// \param history  valid
/// O(size of the history) time. Memory: 37 bytes per entry, including describe_patches(); if a patch has no
/// entries, also 8 bytes per patch
ReplayTables replay_patches(const CollapseHistory& history);

/// Computes bounds, patch_component and mean_edge.
/// \param surface_patches  per face of the original: number of its surface patch
/// \param replay           result of replay_patches(history), to which the tables are added
/// O(n log n) in the entries
void describe_patches(const CollapseHistory& history, std::span<const Index> surface_patches,
                      const RunContext& context, ReplayTables& replay);

FAQEM_DETAIL_END

#ifdef FAQEM_HEADER_ONLY
#include "faqem/detail/mapping/replay-inl.hpp"
#endif
