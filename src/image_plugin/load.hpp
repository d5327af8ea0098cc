#pragma once
/// \file
/// For the command and the C door, which load what reads and writes images with the first one: OpenImageIO brings
/// some 250 shared libraries, that take .3 s and 130 MB, also where there is no image.

#include <filesystem>

#include "asset/image/image_codec.hpp"

namespace faqem::image_plugin {

/// Loads the module. It stays, since the libraries below it have threads of their own.
/// \param program_folder  the folder of the program or library that asks
/// \throws Error  if the module is neither there nor where it is installed, or is of another version
const detail::ImageCodec& load_codec(const std::filesystem::path& program_folder);

}  // namespace faqem::image_plugin
