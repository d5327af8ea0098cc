#pragma once
/// \file
/// Names of the files that are written beside a .gltf or .obj file.

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "faqem/export.hpp"

namespace faqem::detail {

/// File name of the buffer of STEM.gltf: STEM.bin.
FAQEM_EXPORT std::string buffer_file_name(const std::string& stem);

/// File name of the material library of STEM.obj: STEM.mtl.
FAQEM_EXPORT std::string library_file_name(const std::string& stem);

/// File name of an image of STEM.gltf or STEM.obj: STEM_0.png ...
/// \param number     of the image, from 0
/// \param extension  with its dot
FAQEM_EXPORT std::string image_file_name(const std::string& stem, std::size_t number,
                                         const std::string& extension);

/// Finds the files that exist and that save() may replace when it writes the models: buffers, libraries, and
/// images of any number and extension. Models of other formats have none. On a file system that ignores
/// case, files whose names differ in case are found too.
/// Complexity: lists each folder once.
/// \throws WriteError  a folder of a .gltf or .obj file exists and cannot be listed
FAQEM_EXPORT std::vector<std::filesystem::path> existing_side_files(
    const std::vector<std::filesystem::path>& models);

}  // namespace faqem::detail
