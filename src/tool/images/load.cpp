// Takes the place of the library's own image_codec(), which is linked to OpenImageIO.

#include <dlfcn.h>

#include <filesystem>
#include <string>

#include "asset/image_codec.hpp"
#include "faqem/error.hpp"
#include "tool/interrupt.hpp"

namespace faqem::detail {
namespace {

namespace fs = std::filesystem;

/// Beside the command where it was built, and where the libraries are once it is installed.
fs::path module_file() {
    const fs::path here = fs::read_symlink("/proc/self/exe").parent_path();
    const fs::path built = here / FAQEM_IMAGES_MODULE;
    return fs::exists(built) ? built : (here / FAQEM_IMAGES_FOLDER / FAQEM_IMAGES_MODULE).lexically_normal();
}

/// It stays loaded: the libraries below it have threads of their own. A signal ends the process at once meanwhile.
const ImageCodec& load() {
    const tool::Unattended unattended;
    const std::string file = module_file().string();
    void* const module = dlopen(file.c_str(), RTLD_LAZY | RTLD_LOCAL);
    if (!module) throw Error(std::string("cannot read or write images: ") + dlerror());
    using Entry = const ImageCodec*();
    Entry* const entry = reinterpret_cast<Entry*>(dlsym(module, "faqem_image_codec"));
    if (!entry) throw Error(file + ": is not the module of faqem for images");
    const ImageCodec& codec = *entry();
    if (codec.version != std::string(FAQEM_VERSION))
        throw Error(file + ": is of faqem " + codec.version + ", the command of " FAQEM_VERSION);
    return codec;
}

}  // namespace

const ImageCodec& image_codec() {
    static const ImageCodec& codec = load();
    return codec;
}

}  // namespace faqem::detail
