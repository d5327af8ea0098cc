#pragma once
/// \file
/// A simplification run with one or more face counts as targets.

#include <cstdint>
#include <span>
#include <vector>

#include "faqem/export.hpp"
#include "faqem/simplify.hpp"

FAQEM_NAMESPACE_BEGIN
namespace detail {

/// Simplifies to each target in turn, continuing from the mesh of the previous target. Vertex fitting and
/// edge flips of a result (preset best) are not passed on to the next target. The counts in a report are
/// totals since the original; the times are those of the one target. Defined in simplify-inl.hpp.
/// \param mesh     see simplify(); read only during the call
/// \param targets  face counts, not empty, in descending order
/// \param options  must be valid; `target` and `max_error` are ignored
/// \return one result per target. If the run is cancelled, the last result has StopReason::cancelled and the
///         results of the following targets are missing.
/// \throws InputError  as simplify()
/// \throws whatever the progress callback throws
/// Complexity: O(n log n) for all targets together
FAQEM_EXPORT std::vector<SimplifyResult> run_to_targets(const MeshView& mesh,
                                                        std::span<const std::uint64_t> targets,
                                                        const Options& options);

}  // namespace detail
FAQEM_NAMESPACE_END
