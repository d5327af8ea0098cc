#pragma once
/// \file
/// Protection of files beside a model that another model of the same name needs.

#include <filesystem>
#include <span>

namespace faqem::cli {

/// Checks files that are written together: the files beside STEM.gltf and STEM.obj have names that both use
/// (STEM_0.png), so that writing one model could replace an image of the other. For each .gltf and .obj file
/// among the files, STEM.gltf, STEM.obj and STEM.mtl of its folder are examined if they are not written
/// themselves.
/// \param files  paths as they are written
/// \throws WriteError  an existing file would be overwritten that such a model or library refers to; the
///                     message names both
/// Complexity: reads the other models, if one of the files beside the model exists.
void check_side_files_unshared(std::span<const std::filesystem::path> files);

}  // namespace faqem::cli
