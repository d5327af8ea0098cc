#pragma once
/// \file
/// What users call, as parts of a call that has a context, and baking of levels of detail one after the other.

#include <functional>
#include <vector>

#include "faqem/bake_levels.hpp"
#include "faqem/engine/util/run_context.hpp"
#include "faqem/export.hpp"

namespace faqem::detail {

/// bake() of assets.
SimplifiedAsset bake(const Asset& source, const SimplifiedParts& simplified, const Options& options,
                     const engine::RunContext& context);

/// simplify() of assets.
SimplifiedAsset simplify(const Asset& source, const Options& options, const engine::RunContext& context);

/// Bakes each level, so that the images of one are in memory at a time. The progress callback gets Phase::bake once over
/// all levels.
/// \param levels  as simplify_parts_levels() returns them
/// \param use     gets each level; Continue::cancel ends
/// \throws whatever bake() and `use` throw
FAQEM_EXPORT void bake_levels(const Asset& source, std::vector<SimplifiedPartsLevel> levels,
                              const Options& options,
                              const std::function<Continue(SimplifiedAssetLevel)>& use);

}  // namespace faqem::detail
