#pragma once
/// \file
/// How messages name parts, materials and counts.

#include <cstddef>
#include <cstdint>
#include <string>

#include "faqem/asset.hpp"
#include "faqem/export.hpp"

namespace faqem::detail {

/// `1 face`, `2 faces`.
FAQEM_EXPORT std::string pluralized(std::uint64_t count, const std::string& noun);

/// `12 bytes`.
std::string bytes_text(std::uint64_t count);

/// `material 'red'`, or `material 3` if it has no name.
FAQEM_EXPORT std::string material_title(const Asset& asset, Index material);

/// `part 'leg'`, or `part 3` if it has no name.
FAQEM_EXPORT std::string part_title(const Asset& asset, std::size_t part);

}  // namespace faqem::detail
