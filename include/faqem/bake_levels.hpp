#pragma once
/// \file
/// Levels of detail of a textured asset. Needs only the standard library.

#include <filesystem>
#include <string>
#include <vector>

#include "faqem/bake.hpp"
#include "faqem/export.hpp"
#include "faqem/levels.hpp"

namespace faqem {

/// Geometry of one level; input of bake().
struct SimplifiedPartsLevel {
    SimplifiedParts result;  ///< the times of its report are those of this level only
    double distance = 0;     ///< as SimplifiedLevel::distance, in scene units
    double error = 0;        ///< as SimplifiedLevel::error, in scene units
};

/// One level with its baked appearance.
struct SimplifiedAssetLevel {
    SimplifiedAsset result;
    double distance = 0;  ///< as SimplifiedPartsLevel::distance
    double error = 0;     ///< as SimplifiedPartsLevel::error
};

/// Whether the levels share textures.
enum class LevelTextures {
    each,    ///< every level has its own textures
    shared,  ///< one set of textures, baked for the finest level; the other levels keep its UVs
};

/// Simplifies the parts of an asset to several levels of detail, as simplify_levels(const MeshView&, ...).
/// \param source   the asset; read only during the call
/// \param levels   from fine to coarse. Face counts are totals over all parts and are distributed according
///                 to Options::budget, but no part gets more than for the previous count. Distances are in scene
///                 units
/// \param options  as for simplify_parts(); target, max_error and max_seconds must be unset
/// \return one result per level, each with the history that bake() needs. If the progress callback cancels,
///         report.stop of the last result is StopReason::cancelled, and results may be missing
/// \throws OptionError, InputError  as simplify_parts() and simplify_levels()
FAQEM_EXPORT std::vector<SimplifiedPartsLevel> simplify_parts_levels(const Asset& source,
                                                                     const std::vector<Level>& levels,
                                                                     const Options& options = {});

/// Simplifies an asset to several levels of detail and bakes each: simplify_parts_levels(), then bake(). The
/// progress callback gets Phase::simplify, then Phase::bake, each once over all levels. With
/// LevelTextures::shared, Phase::bake includes the simplification of all levels but the finest.
/// \param source    the asset; read only during the call
/// \param levels    as for simplify_parts_levels()
/// \param options   as for simplify_parts_levels()
/// \param textures  with `shared` the finest level gets an atlas of charts, and the other levels are
///                  simplified from it and preserve its UV seams. Their costs refer to the finest level,
///                  their errors are measured against the original. Only the first result has Report::pages
///                  and a correspondence
/// \return one result per level. If the progress callback cancels, report.stop of the last result is
///         StopReason::cancelled, and results may be missing
/// \throws OptionError  with `shared`: BakeOptions::kind is neither `automatic` nor `atlas`, the history or
///                      preserved group boundaries are requested, or welding is off
/// \throws OptionError, InputError, UnsupportedError  as simplify_parts_levels() and bake()
FAQEM_EXPORT std::vector<SimplifiedAssetLevel> simplify_levels(const Asset& source,
                                                               const std::vector<Level>& levels,
                                                               const Options& options = {},
                                                               LevelTextures textures = LevelTextures::each);

/// Saves levels as one .glb, .gltf or .vrm file with the extension MSFT_lod, as save_levels(std::vector<SavedLevel>, ...),
/// with the coverages at which their errors have a size on screen.
/// \param levels        from fine to coarse, at least one. For the original as the first one, its error is 0
/// \param file          name ending in .glb, .gltf or .vrm
/// \param overwrite     whether existing files may be replaced
/// \param screen_error  largest size of an error, as a share of the screen height, finite and > 0
/// \return what the format cannot store
/// \throws OptionError  `screen_error` is out of range
/// \throws InputError, UnsupportedError, WriteError  as the other overload
FAQEM_EXPORT std::vector<std::string> save_levels(std::vector<SimplifiedAssetLevel> levels,
                                                  const std::filesystem::path& file,
                                                  Overwrite overwrite = Overwrite::no,
                                                  double screen_error = 1.0 / 1080);

}  // namespace faqem
