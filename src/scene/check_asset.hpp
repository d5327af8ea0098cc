#pragma once
/// \file
/// Validation of assets, which need not come from a file reader.

#include "faqem/asset.hpp"
#include "faqem/export.hpp"

namespace faqem::detail {

/// Checks that every array of a part has the expected length or is empty, that every index is in range, and
/// that all values of vertices, texture transforms and material factors are finite.
/// Complexity: O(size of the asset).
/// \throws InputError with the name of the part or material
FAQEM_EXPORT void check_asset(const Asset& asset);

}  // namespace faqem::detail
