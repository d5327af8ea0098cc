#pragma once
/// \file
/// Levels of detail of an asset that share one new texture.

#include <span>
#include <vector>

#include "faqem/bake_levels.hpp"
#include "faqem/detail/lod/lod_chain.hpp"
#include "scene/parts/parts_error_bound_search.hpp"

namespace faqem::detail {

/// Checks that options are compatible with LevelTextures::shared.
/// \throws OptionError if they are not
void check_shared_texture(const Options& options);

/// Simplifies and bakes the finest level, and makes the other levels from it, with its UVs and images. Every
/// level is measured against the original.
/// \param source         must have passed check_asset()
/// \param measured       the parts of `source`
/// \param level_targets  as returned by level_targets() for `source`, at least one
/// \param options        must be valid and have passed check_shared_texture()
/// \return as simplify_levels()
std::vector<SimplifiedAssetLevel> levels_with_shared_texture(const Asset& source,
                                                             const ReferenceParts& measured,
                                                             std::span<const LevelTarget> level_targets,
                                                             const Options& options,
                                                             const RunContext& context);

}  // namespace faqem::detail
