#pragma once
/// \file
/// The collapse history: the sequence of collapses from the original to the simplified mesh, as plain data.
///
/// Vertices are immutable *versions*. Version i < positions.size() is a vertex of the original after welding;
/// collapse k merges two existing versions into version positions.size() + k. Time k is just before collapse
/// k: time 0 is the original, time collapses.size() the simplified mesh. Faces keep their input index.

#include <cstdint>
#include <iosfwd>
#include <span>
#include <vector>

#include "faqem/export.hpp"
#include "faqem/mesh.hpp"

FAQEM_NAMESPACE_BEGIN

/// One collapse: versions `first` and `second` are merged into a new one at `position` (model units).
struct Collapse {
    Index first = no_index;
    Index second = no_index;
    Vec3 position = {};

    bool operator==(const Collapse&) const = default;
};

/// A face that was deleted at `time`: with its connected component or as a duplicate by the starvation
/// ladder, or at time 0 by pruning.
struct DeletedFace {
    std::uint64_t time = 0;
    Index face = no_index;

    bool operator==(const DeletedFace&) const = default;
};

/// The record of one run. Owns its arrays. Below, V0 and F0 are the numbers of vertices (after welding) and
/// faces of the original.
struct CollapseHistory {
    std::vector<Vec3> positions;      ///< V0, the original vertices after welding, model units
    std::vector<Triangle> triangles;  ///< F0, the input faces; three no_index if dropped before the run
    std::vector<Index> face_groups;   ///< empty, or F0
    std::vector<Collapse> collapses;  ///< in order
    /// Offsets into patch_faces: number of patches + 1, starting at 0. Patch k < collapses.size() has the
    /// faces around collapse k just before it, including those that it removes. The remaining patches are
    /// edge flips after the last collapse (Preset::best), in order: two faces (a, b, c) and (b, a, d), each
    /// starting at any corner, become (a, d, c) and (b, c, d).
    std::vector<std::uint64_t> patch_begin;
    std::vector<Index> patch_faces;          ///< see patch_begin
    std::vector<DeletedFace> deleted_faces;  ///< by ascending time
    std::vector<Index> remaining_versions;   ///< version of each simplified vertex
    std::vector<Index> remaining_faces;      ///< input face of each simplified face
    /// Empty, or the final position of each simplified vertex, if vertices moved after the last collapse
    /// (Preset::best, or rounding to Asset::precision). The positions of the versions are those before that.
    std::vector<Vec3> final_positions;

    bool empty() const { return remaining_faces.empty(); }
    /// Number of patches: collapses, then edge flips.
    std::size_t patch_count() const { return patch_begin.empty() ? 0 : patch_begin.size() - 1; }
    std::span<const Index> patch(std::size_t k) const {
        return std::span(patch_faces).subspan(patch_begin[k], patch_begin[k + 1] - patch_begin[k]);
    }
    /// Position of a simplified vertex. O(1)
    const Vec3& final_position(std::size_t vertex) const {
        return final_positions.empty() ? position(remaining_versions[vertex]) : final_positions[vertex];
    }
    /// Position of a version. O(1)
    const Vec3& position(Index version) const {
        return version < positions.size() ? positions[version]
                                          : collapses[version - positions.size()].position;
    }
};

/// Checks that all positions are finite and all indices in range, that every collapse merges two existing
/// versions that were not merged before, and that remaining vertices and faces and edge flips are consistent.
/// \throws InputError  names the first invalid element
/// Complexity: O(size of the history).
FAQEM_EXPORT void validate(const CollapseHistory& history);

/// Reconstructs the simplified mesh from the history. Corner attributes are not part of a history.
/// \pre validate(history) passes
/// Complexity: O(size of the history).
FAQEM_EXPORT TriangleMesh replay(const CollapseHistory& history);

/// Writes a history in the binary little-endian format of docs/history-format.md.
/// \param out  a binary stream
/// \throws WriteError  writing failed
/// Complexity: O(size of the history).
FAQEM_EXPORT void write(const CollapseHistory& history, std::ostream& out);

/// Reads and validates a history that write() wrote. Memory is allocated only for bytes that are present.
/// \param in  a binary stream, left just after the history
/// \throws InputError  names the invalid section
/// Complexity: O(size of the history).
FAQEM_EXPORT CollapseHistory read_history(std::istream& in);

FAQEM_NAMESPACE_END

#ifdef FAQEM_HEADER_ONLY
#include "faqem/detail/history/history-inl.hpp"
#endif
