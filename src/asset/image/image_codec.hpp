#pragma once
/// \file
/// What turns images into pixels and back: the room that knows OpenImageIO.

#include <cstdint>
#include <string>

#include "faqem/asset.hpp"
#include "faqem/engine/util/cancellation.hpp"

namespace faqem::detail {

/// A table, so that the command and the C door can load it when the first image comes (images/load.hpp).
struct ImageCodec {
    /// Version of faqem that it was built with.
    const char* version;
    /// Whether there is a reader of WebP that takes memory.
    bool (*reads_webp)();
    /// \param image   its header has been checked
    /// \param format  png, jpeg or webp
    /// \throws InputError if the image is damaged, and what the poll throws
    Pixels (*decode)(const Image& image, const std::string& format,
                     engine::CancellationCheck check_cancelled);
    /// As the functions of these names in image.hpp.
    Image (*encode_png)(const Pixels& pixels, const std::string& name,
                        engine::CancellationCheck check_cancelled);
    Image (*encode_jpeg)(const Pixels& pixels, const std::string& name, std::uint32_t quality,
                         Content content, engine::CancellationCheck check_cancelled);
};

/// \throws Error if it has to be loaded and cannot be
const ImageCodec& image_codec();

}  // namespace faqem::detail
