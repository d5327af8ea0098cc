#include "image_plugin/load.hpp"

#include <dlfcn.h>

#include <string>

#include "faqem/error.hpp"

namespace faqem::image_plugin {

const detail::ImageCodec& load_codec(const std::filesystem::path& program_folder) {
    const std::filesystem::path build_tree_path = program_folder / FAQEM_IMAGE_PLUGIN_FILE;
    const std::filesystem::path installed_path =
        program_folder / FAQEM_IMAGE_PLUGIN_FOLDER / FAQEM_IMAGE_PLUGIN_FILE;
    const std::string file =
        (exists(build_tree_path) ? build_tree_path : installed_path.lexically_normal()).string();
    void* const module = dlopen(file.c_str(), RTLD_LAZY | RTLD_LOCAL);
    if (!module) throw Error(std::string("cannot load the image plugin: ") + dlerror());
    using Entry = const detail::ImageCodec*();
    Entry* const entry = reinterpret_cast<Entry*>(dlsym(module, "faqem_image_codec"));
    if (!entry) throw Error(file + ": is not the image plugin of faqem");
    const detail::ImageCodec& codec = *entry();
    if (codec.version != std::string(FAQEM_VERSION))
        throw Error(file + ": belongs to faqem " + codec.version + " instead of " FAQEM_VERSION);
    return codec;
}

}  // namespace faqem::image_plugin
