// Takes the place of the library's own image_codec(), which is linked to OpenImageIO.

#include "asset/image/image_codec.hpp"

#include <filesystem>

#include "image_plugin/load.hpp"
#include "cli/interrupt.hpp"

namespace faqem::detail {

const ImageCodec& image_codec() {
    static const ImageCodec& codec = []() -> const ImageCodec& {
        const tool::Unattended unattended;
        return images::load(std::filesystem::read_symlink("/proc/self/exe").parent_path());
    }();
    return codec;
}

}  // namespace faqem::detail
