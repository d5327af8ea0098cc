#pragma once
/// \file
/// Validation of assets, which need not come from a file reader, and of options for them.

#include "faqem/asset.hpp"
#include "faqem/options.hpp"

namespace faqem::detail {

/// Checks that every array of a part has the expected length or is empty, that every index is in range, and
/// that all values of vertices, texture transforms and material factors are finite.
/// Complexity: O(size of the asset).
/// \throws InputError with the name of the part or material
void check_asset(const Asset& asset);

/// The options of a run for an asset. Images that are passed through cannot be baked: instead of a new texture or vertex
/// colours, the UVs and images of the source are kept.
Options bakeable_options(const Asset& asset, const Options& options);

}  // namespace faqem::detail
