#pragma once
/// \file
/// Assets need not come from a file: what the baker relies on is checked first.

#include "faqem/asset.hpp"

namespace faqem::detail {

/// Checks that every array of a part has its length or none, that every index is in range, and that every
/// number of a vertex and of a texture's transform is finite. O(size)
/// \throws InputError  naming the part or material
void check_asset(const Asset& asset);

}  // namespace faqem::detail
