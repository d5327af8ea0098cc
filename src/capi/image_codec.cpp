// Replaces the image_codec() of the asset library, which links to OpenImageIO: the C API loads the image
// plugin when the first image is read or written.

#include "asset/image/image_codec.hpp"

#include <dlfcn.h>

#include <filesystem>

#include "image_plugin/load.hpp"

namespace faqem::detail {

const ImageCodec& image_codec() {
    static const ImageCodec& codec = []() -> const ImageCodec& {
        Dl_info library_info = {};
        dladdr(reinterpret_cast<const void*>(&image_codec), &library_info);
        return image_plugin::load_codec(std::filesystem::absolute(library_info.dli_fname).parent_path());
    }();
    return codec;
}

}  // namespace faqem::detail
