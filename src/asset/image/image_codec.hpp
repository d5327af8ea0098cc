#pragma once
/// \file
/// Interface of the image codec for formats other than PNG and JPEG, and the choice of the codec that a program uses.
///
/// There are two codecs: oiio_image_codec() links to OpenImageIO, and plugin_image_codec() loads a plugin
/// that links to it. A program links to the library of one of them, which contains image_codec() and makes the
/// codec the default: faqem_asset_codec_oiio, or faqem_asset_codec_plugin if the CMake target property
/// FAQEM_IMAGE_PLUGIN is on (src/asset/CMakeLists.txt). set_image_codec_provider() sets another codec.

#include <string>

#include "faqem/asset.hpp"
#include "faqem/export.hpp"

namespace faqem::detail {

/// Function table of an image codec.
struct ImageCodec {
    /// Version of faqem that the codec was built with.
    const char* version;
    /// Whether WebP can be decoded.
    bool (*reads_webp)();
    /// Decodes an image.
    /// \param image   its header has been checked
    /// \param format  webp
    /// \throws InputError  if the image is damaged
    Pixels (*decode)(const Image& image, const std::string& format);
};

/// A function that returns the image codec, valid until the process ends. It is called when the codec is
/// needed for the first time, by one thread at a time, and must not use image_codec(). It may throw; then it
/// is called again when the codec is needed the next time.
using ImageCodecProvider = const ImageCodec& (*)();

/// Sets the function that returns the image codec. The default is that of the linked library, see above.
/// Call it before the first image is read or written: a codec that is in use stays in use for calls that
/// have already begun.
/// \return the previous provider
FAQEM_EXPORT ImageCodecProvider set_image_codec_provider(ImageCodecProvider provider);

/// The codec of the current provider.
/// \throws  what the provider throws
const ImageCodec& image_codec();

/// The codec that uses OpenImageIO.
const ImageCodec& oiio_image_codec();

/// Loads the image plugin, which contains oiio_image_codec(). It is never unloaded, since the libraries it
/// depends on have their own threads. The command-line tool and the C library use it because OpenImageIO
/// depends on about 250 shared libraries, which take 0.3 s and 130 MB.
/// \throws Error  if the plugin is neither in the folder of the calling program or library nor at its
///                installed location, or belongs to another version
const ImageCodec& plugin_image_codec();

}  // namespace faqem::detail
