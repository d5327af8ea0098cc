#pragma once
/// \file
/// Levels of detail: one run, many meshes, from fine to coarse.

#include <variant>
#include <vector>

#include "faqem/export.hpp"
#include "faqem/simplify.hpp"

FAQEM_NAMESPACE_BEGIN

/// What one level is to be: a number of faces (ratio(), faces()), or the smallest mesh found within a
/// distance of the original (model_units(), of_diagonal()).
using Level = std::variant<Target, MaxError>;

/// One level, and how far it is from the original.
struct SimplifiedLevel {
    /// As simplify() gives it: origins and history lead back to the original. Counts of the report are those
    /// since the original, times those of this level alone. Of a level that is a distance, report.max_error
    /// is there.
    SimplifyResult result;
    double distance = 0;  ///< of a point that was found: the two-sided distance is not smaller. Model units
    /// No point of original or result is farther from the other, and no level before it has a larger error:
    /// the larger of both, so that errors ascend. Infinity where nothing is left.
    double error = 0;
};

/// Simplifies to one level after the other: each goes on from the one before, and is measured against the
/// original. What comes after the last collapse (preset best moves the vertices) is done to a copy, so that
/// the next level does not suffer from it. One level alone is what simplify() gives.
/// \param mesh     any triangle soup; read only during the call
/// \param levels   from fine to coarse: counts (ratios are of the original's faces) must not ascend,
///                 distances not descend. A count above what the level before has gives that mesh again; so
///                 does a distance that it exceeds, with a warning.
/// \param options  as for simplify(); target and max_error have to be unset
/// \return one per level; where progress cancelled, the last one's stop says so, and the others are those
///         that were ready. An empty mesh gives empty results.
/// \throws OptionError  a level is out of range or finer than the one before, or an option is out of range
/// \throws InputError   as simplify()
/// Complexity: for counts one run, and one measurement for each. A distance takes up to 12 runs more, from
/// the original over the levels before it, each measured.
FAQEM_EXPORT std::vector<SimplifiedLevel> simplify_levels(const MeshView& mesh,
                                                          const std::vector<Level>& levels,
                                                          const Options& options = {});

FAQEM_NAMESPACE_END

#ifdef FAQEM_HEADER_ONLY
#include "faqem/detail/lod/levels-inl.hpp"
#endif
