#pragma once
/// \file
/// Parts that the simplification leaves as they are.

#include <cstdint>
#include <vector>

#include "faqem/bake.hpp"

namespace faqem::detail {

/// By part of the source: whether it is kept as it is (BakeOptions::untouched). Such a part has as many faces
/// as its target allows, apart from duplicates and faces without area, and no vertex has moved.
/// \param simplified  matches the source
/// Complexity: O(faces).
std::vector<std::uint8_t> find_untouched_parts(const Asset& source, const SimplifiedParts& simplified,
                                               const BakeOptions& bake);

}  // namespace faqem::detail
