#pragma once
/// \file
/// The rules for numbers no mesh can use, the same for every format.

#include <cstdint>
#include <string>
#include <vector>

#include "faqem/asset.hpp"

namespace faqem::detail {

/// Most vertices, or faces, a part may have.
inline constexpr std::uint64_t max_index_count = no_index;

/// `1 face`, `2 faces`.
std::string pluralized(std::uint64_t count, const std::string& noun);

/// \throws InputError  when there are more than max_index_count
/// \param element  what in the file is counted, e.g. `vertex`
FAQEM_EXPORT void check_index_count(std::uint64_t count, const std::string& file, const std::string& element);

/// Drops the faces at vertices with a non-finite position, and those vertices; resets other non-finite
/// numbers (normal to zero, UV to zero, colour to white). Adds one counted warning for each kind.
/// \param dropped  faces the reader has left out already for the same reason
/// \throws InputError  `no faces` when none is left
void repair_non_finite(Part& part, const std::string& file, std::uint64_t dropped,
                       std::vector<std::string>& warnings);

}  // namespace faqem::detail
