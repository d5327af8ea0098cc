#pragma once
/// \file
/// Decoding of images other than PNG, JPEG and WebP by a plugin, which is loaded when it is first needed.

#include <string>

#include "faqem/asset.hpp"

namespace faqem::detail {

/// Function table of the plugin.
struct ImagePlugin {
    /// Version of faqem that the plugin was built with.
    const char* version;
    /// Decodes an image.
    /// \param format  the name that OpenImageIO has for the format, for example targa
    /// \throws InputError        the image is damaged
    /// \throws UnsupportedError  it has more than 8 channels, or more than 32 bits per channel
    /// \pre the size in the header is plausible
    Pixels (*decode)(const Image& image, const std::string& format);
};

/// Loads the plugin, with the first call. It is never unloaded, since the libraries it depends on have their own
/// threads. It is a plugin because OpenImageIO depends on about 250 shared libraries, which take 0.3 s and
/// 130 MB.
/// \throws Error  the plugin cannot be loaded from the folder of the calling program or library, nor from its
///                installed location, or belongs to another version; the next call tries again
const ImagePlugin& image_plugin();

}  // namespace faqem::detail
