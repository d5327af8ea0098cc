#pragma once
/// \file
/// Interface of the image codec, the only code that uses OpenImageIO.

#include <cstdint>
#include <string>

#include "faqem/asset.hpp"
#include "faqem/engine/util/cancellation.hpp"

namespace faqem::detail {

/// Function table of the image codec. The command-line tool and the C API load it from a plugin when they
/// need the first image (image_plugin/load.hpp).
struct ImageCodec {
    /// Version of faqem that the codec was built with.
    const char* version;
    /// Whether WebP can be read from memory.
    bool (*reads_webp)();
    /// Decodes an image.
    /// \param image            its header has been checked
    /// \param format           png, jpeg or webp
    /// \param check_cancelled  called between bands of rows
    /// \throws InputError  if the image is damaged
    /// \throws Cancelled   if `check_cancelled` requests it; its other exceptions are passed on
    Pixels (*decode)(const Image& image, const std::string& format,
                     engine::CancellationCheck check_cancelled);
    /// Same as the functions of these names in image.hpp.
    Image (*encode_png)(const Pixels& pixels, const std::string& name,
                        engine::CancellationCheck check_cancelled);
    Image (*encode_jpeg)(const Pixels& pixels, const std::string& name, std::uint32_t quality,
                         Content content, engine::CancellationCheck check_cancelled);
};

/// Returns the image codec.
/// \throws Error  if it is in a plugin that cannot be loaded
const ImageCodec& image_codec();

}  // namespace faqem::detail
