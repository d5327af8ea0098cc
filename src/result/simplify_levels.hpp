#pragma once
/// \file
/// Baking of levels of detail, one after the other.

#include <functional>
#include <vector>

#include "faqem/bake_levels.hpp"
#include "faqem/export.hpp"

namespace faqem::detail {

/// Bakes each level, so that the images of one are in memory at a time. The progress callback gets Phase::bake once over
/// all levels.
/// \param levels  as simplify_parts_levels() returns them
/// \param use     gets each level; Continue::cancel ends
/// \throws whatever bake() and `use` throw
FAQEM_EXPORT void bake_levels(const Asset& source, std::vector<SimplifiedPartsLevel> levels,
                              const Options& options,
                              const std::function<Continue(SimplifiedAssetLevel)>& use);

}  // namespace faqem::detail
