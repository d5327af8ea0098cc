#pragma once
/// \file
/// Levels of detail of a scene in one file.

#include <filesystem>
#include <string>
#include <vector>

#include "faqem/asset.hpp"
#include "faqem/export.hpp"

namespace faqem {

/// A level to be saved.
struct SavedLevel {
    Asset asset;
    /// One per part: the level is for where the part's box has at most this share of the screen's height as
    /// its diagonal. Nothing is made of those of the first level.
    std::vector<double> coverage;
};

/// Saves as .glb or .gltf with the extension MSFT_lod: the scene is that of the first level, and every node
/// with a mesh names nodes with the meshes of the others, which no scene holds. Viewers that do not know the
/// extension show the first level. The coverages go along as the hint MSFT_screencoverage, none above 1, the
/// last 0. Where a node has a place, children or an animation, its mesh goes to a child, so that the levels
/// need no place of their own. Images of equal bytes are stored once.
/// \param levels  from fine to coarse, of one source: with the same parts in the same order; at least one
/// \return what the format could not hold, one sentence each: points and lines are in the first level alone
/// \throws InputError        the levels have not the same number of parts, or not a coverage for each part
/// \throws UnsupportedError  the name does not end in .glb or .gltf
/// \throws WriteError        as save()
FAQEM_EXPORT std::vector<std::string> save_levels(std::vector<SavedLevel> levels,
                                                  const std::filesystem::path& file,
                                                  Overwrite overwrite = Overwrite::no);

}  // namespace faqem
