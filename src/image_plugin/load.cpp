// Loads the image plugin (asset/image/image_codec.hpp).

#include <dlfcn.h>
#include <link.h>

#include <cerrno>
#include <filesystem>
#include <new>
#include <string>
#include <system_error>

#include "asset/image/image_codec.hpp"
#include "faqem/error.hpp"

namespace faqem::detail {
namespace {

/// Finds the plugin: in the folder of the program or shared library that contains this code (build tree), or
/// at the installed location relative to that folder.
std::filesystem::path plugin_path() {
    Dl_info info = {};
    link_map* module = nullptr;
    dladdr1(reinterpret_cast<const void*>(&plugin_path), &info, reinterpret_cast<void**>(&module),
            RTLD_DL_LINKMAP);
    // In the list of the dynamic linker the program has no name.
    const bool is_library = module && *module->l_name;
    const std::filesystem::path own_path = is_library ? std::filesystem::absolute(module->l_name)
                                                      : std::filesystem::read_symlink("/proc/self/exe");
    const std::filesystem::path folder = own_path.parent_path();
    const std::filesystem::path build_tree_path = folder / FAQEM_IMAGE_PLUGIN_FILE;
    if (exists(build_tree_path)) return build_tree_path;
    const char* const installed_folder =
        is_library ? FAQEM_IMAGE_PLUGIN_FOLDER_FROM_LIBRARY : FAQEM_IMAGE_PLUGIN_FOLDER_FROM_PROGRAM;
    return (folder / installed_folder / FAQEM_IMAGE_PLUGIN_FILE).lexically_normal();
}

}  // namespace

const ImageCodec& plugin_image_codec() {
    const std::string file = plugin_path().string();
    void* const module = dlopen(file.c_str(), RTLD_LAZY | RTLD_LOCAL);
    if (!module) {
        const std::string error = dlerror();
        if (error.ends_with(std::generic_category().message(ENOMEM))) throw std::bad_alloc();
        throw Error("cannot load the image plugin: " + error);
    }
    using Entry = const ImageCodec*();
    Entry* const entry = reinterpret_cast<Entry*>(dlsym(module, "faqem_image_codec"));
    if (!entry) throw Error(file + ": is not the image plugin of faqem");
    const ImageCodec& codec = *entry();
    if (codec.version != std::string(FAQEM_VERSION))
        throw Error(file + ": belongs to faqem " + codec.version + " instead of " FAQEM_VERSION);
    return codec;
}

}  // namespace faqem::detail
