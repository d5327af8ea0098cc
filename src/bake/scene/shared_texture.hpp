#pragma once
/// \file
/// Levels of detail of an asset that share one new texture.

#include <span>
#include <vector>

#include "bake/scene/parts_error_bound_search.hpp"
#include "faqem/bake_levels.hpp"
#include "faqem/detail/lod/lod_chain.hpp"

namespace faqem::detail {

/// \throws OptionError  the options do not go together with LevelTextures::shared
void check_shared_texture(const Options& options);

/// Bakes the finest level, and makes the others of it with its UVs. Each is measured against the original.
/// \param measured  of the source
/// \param level_targets     of the source, at least one
/// \pre options are valid and checked as above, the asset is checked
/// \return as simplify_levels()
std::vector<SimplifiedAssetLevel> levels_with_shared_texture(const Asset& source,
                                                             const ReferenceParts& measured,
                                                             std::span<const LevelTarget> level_targets,
                                                             const Options& options);

}  // namespace faqem::detail
