#pragma once
/// \file
/// Saving the levels of detail of a scene in one glTF file.

#include <filesystem>
#include <string>
#include <vector>

#include "faqem/asset.hpp"
#include "faqem/export.hpp"

namespace faqem {

/// One level of save_levels().
struct SavedLevel {
    Asset asset;
    /// One per part: the largest screen coverage at which the level is used, as the diagonal of the part's
    /// bounding box relative to the screen height. Ignored for the first level.
    std::vector<double> coverage;
};

/// Saves levels of detail as one .glb, .gltf or .vrm file with the extension MSFT_lod.
///
/// The scene is that of the first level. Every node with a mesh refers to nodes with the meshes of the other
/// levels, which are not part of a scene; viewers without the extension show the first level. The coverages
/// are written as MSFT_screencoverage, at most 1 and non-increasing, the last one 0. If a node has a
/// transform, children, a camera or an animation, its mesh is moved to a new child node, so that the nodes of
/// the other levels need no transform. Identical images are stored once. Coarser levels that an asset has already are
/// left out.
/// \param levels     from fine to coarse, at least one, with the same parts in the same order
/// \param file       name ending in .glb, .gltf or .vrm
/// \param overwrite  whether existing files may be replaced
/// \return what the format cannot store, one sentence each; points and lines are in the first level only
/// \throws InputError        the levels differ in their number of parts, or lack a coverage for each part
/// \throws UnsupportedError  the file name does not end in .glb, .gltf or .vrm
/// \throws WriteError        as save()
/// Complexity: O(size of the assets).
FAQEM_EXPORT std::vector<std::string> save_levels(std::vector<SavedLevel> levels,
                                                  const std::filesystem::path& file,
                                                  Overwrite overwrite = Overwrite::no);

}  // namespace faqem
