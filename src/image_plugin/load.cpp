#include "image_plugin/load.hpp"

#include <dlfcn.h>

#include <string>

#include "faqem/error.hpp"

namespace faqem::images {

const detail::ImageCodec& load(const std::filesystem::path& here) {
    const std::filesystem::path built = here / FAQEM_IMAGES_MODULE;
    const std::filesystem::path installed = here / FAQEM_IMAGES_FOLDER / FAQEM_IMAGES_MODULE;
    const std::string file = (exists(built) ? built : installed.lexically_normal()).string();
    void* const module = dlopen(file.c_str(), RTLD_LAZY | RTLD_LOCAL);
    if (!module) throw Error(std::string("cannot read or write images: ") + dlerror());
    using Entry = const detail::ImageCodec*();
    Entry* const entry = reinterpret_cast<Entry*>(dlsym(module, "faqem_image_codec"));
    if (!entry) throw Error(file + ": is not faqem's module for images");
    const detail::ImageCodec& codec = *entry();
    if (codec.version != std::string(FAQEM_VERSION))
        throw Error(file + ": is of faqem " + codec.version + " instead of " FAQEM_VERSION);
    return codec;
}

}  // namespace faqem::images
