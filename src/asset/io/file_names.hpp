#pragma once
/// \file
/// Extensions, and the names of the files that are written beside a model.

#include <cstddef>
#include <filesystem>
#include <string>

#include "faqem/detail/base/lower_case.hpp"

namespace faqem::detail {

/// Returns the extension of a file name with its dot, in lower case (ASCII).
inline std::string lower_case_extension(const std::filesystem::path& file) {
    return lower_case(file.extension().string());
}

/// File name of the buffer of STEM.gltf: STEM.bin.
std::string buffer_file_name(const std::string& stem);

/// File name of the material library of STEM.obj: STEM.mtl.
std::string library_file_name(const std::string& stem);

/// File name of an image beside a model: STEM_0.png ...
/// \param number     of the image, from 0
/// \param extension  with its dot
std::string image_file_name(const std::string& stem, std::size_t number, const std::string& extension);

}  // namespace faqem::detail
