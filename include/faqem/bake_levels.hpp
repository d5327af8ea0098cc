#pragma once
/// \file
/// Levels of detail of a textured asset. Needs the standard library only.

#include <vector>

#include "faqem/bake.hpp"
#include "faqem/export.hpp"
#include "faqem/levels.hpp"

namespace faqem {

/// The geometry of one level, to be given to bake().
struct SimplifiedPartsLevel {
    SimplifiedParts result;  ///< times of the report are those of this level alone
    double distance = 0;     ///< as SimplifiedLevel::distance, in units of the scene
    double error = 0;        ///< as SimplifiedLevel::error, in units of the scene
};

/// One level with its look.
struct SimplifiedAssetLevel {
    SimplifiedAsset result;
    double distance = 0;  ///< as SimplifiedPartsLevel
    double error = 0;     ///< as SimplifiedPartsLevel
};

/// Which images the levels have.
enum class LevelTextures {
    each,    ///< every level its own
    shared,  ///< all the same, baked for the finest level, whose UVs the others keep
};

/// As simplify_levels(), for the parts of an asset. Counts are those of the whole asset; each is spread over
/// the parts as Options::budget says, but no part gets more faces than in the level before. Distances are in
/// units of the scene.
/// \return one per level, each with the history that bake() needs; one alone, whose stop says so, where
///         progress cancelled
/// \throws as simplify_parts() and simplify_levels()
FAQEM_EXPORT std::vector<SimplifiedPartsLevel> simplify_parts_levels(const Asset& source,
                                                                     const std::vector<Level>& levels,
                                                                     const Options& options = {});

/// Both stages for all levels. Progress is told of Phase::simplify, then of Phase::bake, for all levels
/// together.
/// \param textures  with `shared` the finest level gets an atlas of charts, and the others are made of it, with
///                  its UVs and seams: their collapses know the finest level, their errors are measured
///                  against the original. Pages and correspondence are in the first result alone.
/// \return one per level; where progress cancelled, the last one's stop says so, and those after it are
///         missing
/// \throws OptionError  with `shared`: no atlas of charts is baked, a history or kept groups are asked for, or
///                      nothing is to be welded
/// \throws as simplify_parts_levels() and bake()
FAQEM_EXPORT std::vector<SimplifiedAssetLevel> simplify_levels(const Asset& source,
                                                               const std::vector<Level>& levels,
                                                               const Options& options = {},
                                                               LevelTextures textures = LevelTextures::each);

}  // namespace faqem
