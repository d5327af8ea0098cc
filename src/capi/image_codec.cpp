// Takes the place of the library's own image_codec(), which is linked to OpenImageIO.

#include "asset/image/image_codec.hpp"

#include <dlfcn.h>

#include <filesystem>

#include "image_plugin/load.hpp"

namespace faqem::detail {

const ImageCodec& image_codec() {
    static const ImageCodec& codec = []() -> const ImageCodec& {
        Dl_info door = {};
        dladdr(reinterpret_cast<const void*>(&image_codec), &door);
        return images::load(std::filesystem::absolute(door.dli_fname).parent_path());
    }();
    return codec;
}

}  // namespace faqem::detail
