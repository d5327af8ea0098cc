#pragma once
/// \file
/// The collapse history: plain data that says how the original became the small mesh.
///
/// Vertices are immutable *versions*. Version i < positions.size() is a (welded) vertex of the original;
/// collapse k joins two older versions and makes version positions.size() + k. Time k is the moment before
/// collapse k, so time 0 is the original and time collapses.size() the small mesh. Faces keep the index they
/// had in the input for as long as they live.

#include <cstdint>
#include <iosfwd>
#include <span>
#include <vector>

#include "faqem/export.hpp"
#include "faqem/mesh.hpp"

FAQEM_NAMESPACE_BEGIN

/// One collapse: versions `first` and `second` became a new one at `position` (model units).
struct Collapse {
    Index first = no_index;
    Index second = no_index;
    Vec3 position = {};
};

/// A whole component deleted by the starvation ladder, or pruned at time 0: `face` was gone from time `time`
/// on.
struct DeletedFace {
    std::uint64_t time = 0;
    Index face = no_index;
};

/// Everything recorded in one run. Owns its arrays.
struct CollapseHistory {
    std::vector<Vec3> positions;      ///< V0 vertices of the original after welding
    std::vector<Triangle> triangles;  ///< F0 input faces over them; three no_index: dropped before the run
    std::vector<Index> face_groups;   ///< empty, or F0 groups
    std::vector<Collapse> collapses;  ///< in order
    /// Faces that touched a collapse, just before it: collapse k's are
    /// patch_faces[patch_begin[k] .. patch_begin[k + 1]), those that vanish in it included. The patches
    /// beyond the collapses are edge flips after all of them: two faces (a, b, c) and (b, a, d) that became
    /// (a, d, c) and (b, c, d), not necessarily from that corner on (preset best).
    std::vector<std::uint64_t> patch_begin;  ///< number of patches + 1, starts with 0
    std::vector<Index> patch_faces;
    std::vector<DeletedFace> deleted_faces;  ///< by time
    std::vector<Index> kept_versions;        ///< version of each vertex of the small mesh, in its order
    std::vector<Index> kept_faces;           ///< input face of each face of the small mesh, in its order
    /// Empty, or where each vertex of the small mesh went after the last collapse (preset best). The versions
    /// stay where they were.
    std::vector<Vec3> kept_positions;

    bool empty() const { return kept_faces.empty(); }
    /// Collapses, then flips.
    std::size_t patch_count() const { return patch_begin.empty() ? 0 : patch_begin.size() - 1; }
    std::span<const Index> patch(std::size_t k) const {
        return {patch_faces.data() + patch_begin[k], patch_begin[k + 1] - patch_begin[k]};
    }
    /// Position of a vertex of the small mesh. O(1)
    const Vec3& kept_position(std::size_t vertex) const {
        return kept_positions.empty() ? position(kept_versions[vertex]) : kept_positions[vertex];
    }
    /// Position of a version. O(1)
    const Vec3& position(Index version) const {
        return version < positions.size() ? positions[version]
                                          : collapses[version - positions.size()].position;
    }
};

/// Checks that every position is finite, every index in range, and that every collapse joins two living versions.
/// O(size)
/// \throws InputError naming the first position, collapse or face that is wrong
FAQEM_EXPORT void validate(const CollapseHistory& history);

/// Rebuilds the small mesh from the history alone.
/// \pre validate(history) passes.
/// O(size)
FAQEM_EXPORT TriangleMesh replay(const CollapseHistory& history);

/// Writes in a little-endian binary format (docs/history-format.md). \throws WriteError
FAQEM_EXPORT void write(const CollapseHistory& history, std::ostream& out);

/// Reads what write() wrote and validates it; memory grows only with the bytes really there.
/// \throws InputError naming the section that is wrong
FAQEM_EXPORT CollapseHistory read_history(std::istream& in);

FAQEM_NAMESPACE_END

#ifdef FAQEM_HEADER_ONLY
#include "faqem/detail/history/history-inl.hpp"
#endif
