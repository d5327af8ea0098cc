#pragma once
/// \file
/// Levels of detail: several meshes from one run, from fine to coarse.

#include <variant>
#include <vector>

#include "faqem/export.hpp"
#include "faqem/simplify.hpp"

FAQEM_NAMESPACE_BEGIN

/// Target of one level: a face count (ratio(), faces()), or the smallest mesh found within a distance of the
/// original (model_units(), of_diagonal()).
using Level = std::variant<Target, MaxError>;

/// One level, with its distance from the original.
struct SimplifiedLevel {
    /// As returned by simplify(): origins and history refer to the original. The counts of the report are
    /// totals since the original, the times are those of this level only. report.max_error is set if the
    /// target of the level is a distance.
    SimplifyResult result;
    double distance = 0;  ///< lower bound of the two-sided Hausdorff distance to the original, model units
    /// Upper bound of that distance, model units, or the error of the previous level if that is larger:
    /// errors never descend. Infinity if no face is left.
    double error = 0;
};

/// Simplifies a mesh to several levels of detail. Each level continues from the previous one and is measured
/// against the original. The final vertex fitting of Preset::best is applied to a copy of the level, so that
/// it does not affect the next one. A single level equals the result of simplify().
/// \param mesh     any triangle soup; read only during the call
/// \param levels   from fine to coarse: face counts (ratios refer to the original's faces) must not increase,
///                 distances must not decrease. A face count above that of the previous level repeats that
///                 level; so does a distance that the previous level exceeds, with a warning
/// \param options  as for simplify(); target, max_error and max_seconds must be unset
/// \return one result per level; for an empty mesh, empty results. If the progress callback cancels,
///         report.stop of the last result is StopReason::cancelled, any results before it are complete, and
///         results may be missing
/// \throws OptionError  a level is out of range or finer than a previous one, or an option is out of range
/// \throws InputError   as simplify()
/// Complexity: for face counts one run, and one measurement per level. Each distance takes up to 12 more
/// runs, from the original over the previous levels, each with a measurement.
FAQEM_EXPORT std::vector<SimplifiedLevel> simplify_levels(const MeshView& mesh,
                                                          const std::vector<Level>& levels,
                                                          const Options& options = {});

FAQEM_NAMESPACE_END

#ifdef FAQEM_HEADER_ONLY
#include "faqem/detail/lod/levels-inl.hpp"
#endif
