#pragma once
/// \file
/// Levels of detail from a stored history, without another run: the history is truncated at a face count.

#include <array>
#include <cstdint>
#include <iosfwd>
#include <span>
#include <vector>

#include "faqem/export.hpp"
#include "faqem/history.hpp"
#include "faqem/simplify.hpp"

FAQEM_NAMESPACE_BEGIN

/// The state of a run at the end of a level other than the last one.
struct HistoryLevel {
    std::uint64_t collapses = 0;  ///< number of collapses before the end of the level
    std::uint64_t deleted = 0;    ///< number of CollapseHistory::deleted_faces before the end of the level
    std::vector<std::array<Index, 2>> flips;  ///< pairs of faces whose edge is flipped in this level only
    std::vector<Index> remaining_versions;    ///< as CollapseHistory::remaining_versions
    std::vector<Index> remaining_faces;       ///< as CollapseHistory::remaining_faces
    std::vector<Vec3> final_positions;        ///< as CollapseHistory::final_positions
};

/// The history of a chain of levels: that of the last level, and the states at the ends of the previous
/// levels.
struct ChainHistory {
    CollapseHistory last;
    std::vector<HistoryLevel> before;  ///< from fine to coarse

    std::size_t level_count() const { return before.size() + 1; }
};

/// Joins the histories of the levels of one run.
/// \param levels  from fine to coarse, as returned by simplify_levels(); at least one
/// \throws InputError  the histories are not of one run, or there are none
/// Complexity: O(total size).
FAQEM_EXPORT ChainHistory join(std::span<const CollapseHistory> levels);

/// Returns the history of one level, equal to that of its run.
/// \pre level < history.level_count()
/// Complexity: O(size of the history).
FAQEM_EXPORT CollapseHistory truncate_to_level(const ChainHistory& history, std::size_t level);

/// Truncates a history at the first time when at most `faces` faces are left. If a level ends there, or has
/// exactly that many faces, the result is the history of that level; otherwise all vertices are at the
/// positions of their last collapse. If the last level has more faces, the result is the last level. For qem,
/// paper and stmw, whose order of collapses does not depend on the target, the result equals that of a run to
/// `faces` if no rung of the ladder was taken.
/// \pre validate() passes for all levels
/// Complexity: O(size of the history).
FAQEM_EXPORT CollapseHistory truncate_to_faces(const ChainHistory& history, std::uint64_t faces);

/// Truncates the histories of all parts of an asset to a total face count. The count of a level gives that
/// level; between two levels, the count of each part is interpolated linearly.
/// \param parts  one per part, with equal numbers of levels; empty histories for parts without faces
/// \param faces  total over all parts
/// \throws InputError  the parts differ in their number of levels
/// Complexity: O(total size).
FAQEM_EXPORT std::vector<CollapseHistory> truncate_to_faces(std::span<const ChainHistory> parts,
                                                            std::uint64_t faces);

/// Reconstructs the result of a run from its history: the mesh without corner attributes, face_origin, the
/// history, and the counts of faces, vertices and collapses in the report. vertex_origin is empty.
/// \pre validate(history) passes
/// Complexity: O(size of the history).
FAQEM_EXPORT SimplifyResult restore(CollapseHistory history);

/// Writes a chain in the binary little-endian format of docs/history-format.md.
/// \param out  a binary stream
/// \throws WriteError  writing failed
/// Complexity: O(size of the history).
FAQEM_EXPORT void write(const ChainHistory& history, std::ostream& out);

/// Reads a chain or a single history that write() wrote, and validates every level.
/// \param in  a binary stream, left just after the history
/// \throws InputError  names the invalid section
/// Complexity: O(levels * size of the history).
FAQEM_EXPORT ChainHistory read_chain_history(std::istream& in);

FAQEM_NAMESPACE_END

#ifdef FAQEM_HEADER_ONLY
#include "faqem/detail/history/truncate-inl.hpp"
#endif
