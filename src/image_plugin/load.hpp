#pragma once
/// \file
/// Loading of the image plugin for the command-line tool and the C library. They load it when they need the
/// first image, because OpenImageIO depends on about 250 shared libraries, which take 0.3 s and 130 MB.

#include <filesystem>

#include "asset/image/image_codec.hpp"

namespace faqem::image_plugin {

/// Loads the image plugin. It is never unloaded, since the libraries it depends on have their own threads.
/// \param program_folder  folder of the calling program or library
/// \return the image codec, valid until the process ends
/// \throws Error  if the plugin is neither in `program_folder` nor at its installed location, or belongs to
///                another version
const detail::ImageCodec& load_codec(const std::filesystem::path& program_folder);

}  // namespace faqem::image_plugin
