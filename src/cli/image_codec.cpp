// Replaces the library's image_codec(), which links OpenImageIO: the command loads the image plugin when the
// first image is read or written.

#include "asset/image/image_codec.hpp"

#include <filesystem>

#include "cli/interrupt.hpp"
#include "image_plugin/load.hpp"

namespace faqem::detail {

const ImageCodec& image_codec() {
    static const ImageCodec& codec = []() -> const ImageCodec& {
        const cli::ExitOnInterrupt exit_on_interrupt;
        return image_plugin::load_codec(std::filesystem::read_symlink("/proc/self/exe").parent_path());
    }();
    return codec;
}

}  // namespace faqem::detail
