#pragma once
/// \file
/// One run of the engine with one target or several.

#include <cstdint>
#include <span>
#include <vector>

#include "faqem/export.hpp"
#include "faqem/simplify.hpp"

FAQEM_NAMESPACE_BEGIN
namespace detail {

/// Simplifies to one target after the other, each from where the one before it ended. What the result of a
/// target gets in the end (relaxation) is not passed on to the next one. Counts in the reports are since the
/// original, times are of the target alone. Defined in simplify.cpp.
/// \param targets  faces, at least one, each at most the one before it
/// \param options  target and max_error do not count
/// \pre options are valid
/// \return one result per target; where it was cancelled, the last one says so, and those after it are
///         missing
/// \throws as simplify().
/// O(n log n) for all of them together
FAQEM_EXPORT std::vector<SimplifyResult> run_to_targets(const MeshView& mesh,
                                                        std::span<const std::uint64_t> targets,
                                                        const Options& options);

}  // namespace detail
FAQEM_NAMESPACE_END
