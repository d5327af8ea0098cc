#pragma once
/// \file
/// One run over all parts of an asset, with one target or several.

#include <cstdint>
#include <span>
#include <vector>

#include "faqem/bake.hpp"

namespace faqem::detail {

/// As run_to_targets(), for assets: each target is spread over the parts as the budget says, and each part goes from
/// level to level. Defined in simplify_parts.cpp.
/// \param targets  faces of all parts, at least one, each at most the one before it
/// \pre options are valid, the asset is checked
/// \return one result per target; where it was cancelled, one alone, which says so
std::vector<SimplifiedParts> simplify_parts_to_targets(const Asset& source,
                                                       std::span<const std::uint64_t> targets,
                                                       const Options& options);

}  // namespace faqem::detail
