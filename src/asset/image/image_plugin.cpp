#include "asset/image/codecs.hpp"

#include <dlfcn.h>
#include <link.h>

#include <cerrno>
#include <filesystem>
#include <new>
#include <string>
#include <system_error>

#include "faqem/error.hpp"

namespace faqem::detail {
namespace {

constexpr const char* ktx2_plugin_file = "faqem-ktx2.so";

/// Finds a plugin by the name of its file: in the folder of the program or shared library that contains this code
/// (build tree), at the installed location relative to that folder, or, for other programs, at the installed location
/// of faqem.
std::filesystem::path plugin_path(const char* name) {
    Dl_info info = {};
    link_map* module = nullptr;
    dladdr1(reinterpret_cast<const void*>(&plugin_path), &info, reinterpret_cast<void**>(&module),
            RTLD_DL_LINKMAP);
    // In the list of the dynamic linker the program has no name.
    const bool is_library = module && *module->l_name;
    const std::filesystem::path own_path = is_library ? std::filesystem::absolute(module->l_name)
                                                      : std::filesystem::read_symlink("/proc/self/exe");
    const std::filesystem::path folder = own_path.parent_path();
    const std::filesystem::path build_tree_path = folder / name;
    if (exists(build_tree_path)) return build_tree_path;
    const char* const installed_folder =
        is_library ? FAQEM_IMAGE_PLUGIN_FOLDER_FROM_LIBRARY : FAQEM_IMAGE_PLUGIN_FOLDER_FROM_PROGRAM;
    const std::filesystem::path moved_path = (folder / installed_folder / name).lexically_normal();
    if (exists(moved_path)) return moved_path;
    return std::filesystem::path(FAQEM_IMAGE_PLUGIN_FOLDER) / name;
}

const ImagePlugin& load_plugin(const char* name) {
    const std::string file = plugin_path(name).string();
    void* const module = dlopen(file.c_str(), RTLD_LAZY | RTLD_LOCAL);
    if (!module) {
        const std::string error = dlerror();
        if (error.ends_with(std::generic_category().message(ENOMEM))) throw std::bad_alloc();
        throw Error("cannot load the image plugin: " + error);
    }
    using Entry = const ImagePlugin*();
    Entry* const entry = reinterpret_cast<Entry*>(dlsym(module, "faqem_image_plugin"));
    if (!entry) throw Error(file + ": is not the image plugin of faqem");
    const ImagePlugin& plugin = *entry();
    if (plugin.version != std::string(FAQEM_VERSION))
        throw Error(file + ": belongs to faqem " + plugin.version + " instead of " FAQEM_VERSION);
    return plugin;
}

}  // namespace

const ImagePlugin& image_plugin() {
    static const ImagePlugin& plugin = load_plugin("faqem-images.so");
    return plugin;
}

#ifdef FAQEM_WITH_KTX2
bool reads_ktx2() {
    static const bool is_installed = exists(plugin_path(ktx2_plugin_file));
    return is_installed;
}
#endif

const ImagePlugin& ktx2_plugin() {
    static const ImagePlugin& plugin = load_plugin(ktx2_plugin_file);
    return plugin;
}

}  // namespace faqem::detail
