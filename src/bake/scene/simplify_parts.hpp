#pragma once
/// \file
/// Simplification of all parts of an asset to one or more targets.

#include <cstdint>
#include <span>
#include <vector>

#include "faqem/bake.hpp"

namespace faqem::detail {

/// As run_to_targets(), for assets. Every target is distributed over the parts according to Options::budget,
/// and every part is simplified from one level to the next.
/// \param source   must have passed check_asset()
/// \param targets  face counts of all parts together: at least one, in descending order
/// \param options  must be valid
/// \return one result per target; a single one with StopReason::cancelled if the progress callback cancels
std::vector<SimplifiedParts> simplify_parts_to_targets(const Asset& source,
                                                       std::span<const std::uint64_t> targets,
                                                       const Options& options);

/// As simplify_parts() without Options::max_error, for a source that is welded (WeldedSource).
/// \param source   must have passed check_asset()
/// \param options  must be valid, without max_error
SimplifiedParts simplify_welded_parts(const Asset& source, const Options& options);

}  // namespace faqem::detail
