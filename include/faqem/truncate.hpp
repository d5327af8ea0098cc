#pragma once
/// \file
/// Levels of detail from a stored history, without another run.

#include <array>
#include <cstdint>
#include <iosfwd>
#include <span>
#include <vector>

#include "faqem/export.hpp"
#include "faqem/history.hpp"
#include "faqem/simplify.hpp"

FAQEM_NAMESPACE_BEGIN

/// What a run had at the end of a level that was not its last one.
struct HistoryLevel {
    std::uint64_t collapses = 0;              ///< how many came before
    std::uint64_t deleted = 0;                ///< how many of CollapseHistory::deleted_faces came before
    std::vector<std::array<Index, 2>> flips;  ///< faces of edges that were flipped then, in this level alone
    std::vector<Index> kept_versions;         ///< as those of CollapseHistory
    std::vector<Index> kept_faces;
    std::vector<Vec3> kept_positions;
};

/// The history of a chain: that of its last level, and what the levels before it had.
struct ChainHistory {
    CollapseHistory last;
    std::vector<HistoryLevel> before;  ///< from fine to coarse

    std::size_t level_count() const { return before.size() + 1; }
};

/// Joins the histories of the levels of one run.
/// \param levels  from fine to coarse, as simplify_levels() gives them; at least one
/// \throws InputError  they are not of one run
/// O(size of all)
FAQEM_EXPORT ChainHistory join(std::span<const CollapseHistory> levels);

/// The history of one level, as its run gave it.
/// \pre level < history.level_count()
/// O(size)
FAQEM_EXPORT CollapseHistory truncate_to_level(const ChainHistory& history, std::size_t level);

/// The history up to where no more than `faces` are left: of a level that the run stopped at there, and of
/// one with just as many faces, as its run gave it, else with every vertex where the last collapse put it.
/// Where even the last level has more faces, that level. For presets whose order of collapses does not depend
/// on the target (qem, paper, stmw) a run to `faces` gives the same, as long as it took no step of the
/// ladder.
/// \pre histories are valid
/// O(size)
FAQEM_EXPORT CollapseHistory truncate_to_faces(const ChainHistory& history, std::uint64_t faces);

/// truncate_to_faces() for the parts of an asset together. As many faces as a level has give that level; others are
/// shared out in proportion between the levels around them.
/// \param parts  with as many levels each; those of parts without faces are empty
/// \throws InputError  the parts have not the same number of levels
FAQEM_EXPORT std::vector<CollapseHistory> truncate_to_faces(std::span<const ChainHistory> parts,
                                                            std::uint64_t faces);

/// The small mesh of a history, as the run gave it. Attributes on corners are not in a history.
/// Of the report the counts of faces, vertices and collapses.
/// \pre validate(history) passes
/// O(size)
FAQEM_EXPORT SimplifyResult restore(CollapseHistory history);

/// Writes in a little-endian binary format (docs/history-format.md). \throws WriteError
FAQEM_EXPORT void write(const ChainHistory& history, std::ostream& out);

/// Reads what write() wrote, of a chain or of one history, and validates every level.
/// \throws InputError naming the section that is wrong
FAQEM_EXPORT ChainHistory read_chain_history(std::istream& in);

FAQEM_NAMESPACE_END

#ifdef FAQEM_HEADER_ONLY
#include "faqem/detail/history/truncate-inl.hpp"
#endif
