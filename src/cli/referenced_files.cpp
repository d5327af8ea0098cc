#include "cli/referenced_files.hpp"

#include <sys/stat.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <fstream>
#include <string_view>

#include "asset/file.hpp"
#include "asset/formats/mtl.hpp"
#include "faqem/error.hpp"
#include "cli/json.hpp"
#include "cli/output_file.hpp"

namespace faqem::tool {

namespace {

namespace fs = std::filesystem;
using detail::Reference;

void add_inside(std::vector<fs::path>& files, const fs::path& folder, const std::string& reference,
                Reference kind) {
    try {
        fs::path file = detail::resolve_inside(folder, reference, kind);
        if (std::find(files.begin(), files.end(), file) == files.end()) files.push_back(std::move(file));
    } catch (const InputError&) {
    }
}

/// The JSON of a .glb file: the first chunk, behind 12 bytes of header and 8 of its own.
std::string glb_json(const fs::path& model) {
    std::ifstream in(model, std::ios::binary);
    std::array<char, 20> head = {};
    if (!in.read(head.data(), head.size()) || std::string_view(head.data(), 4) != "glTF") return {};
    std::uint32_t size = 0;
    for (std::size_t k = 4; k-- > 0;) size = size << 8 | static_cast<std::uint8_t>(head[12 + k]);
    if (size > fs::file_size(model)) return {};
    std::string text(size, ' ');
    in.read(text.data(), size);
    return text;
}

void add_gltf_files(const fs::path& model, std::string_view text, std::vector<fs::path>& files) {
    const Json document = Json::parse(text, nullptr, false);
    for (const char* key : {"buffers", "images"}) {
        if (!document.is_object() || !document.contains(key) || !document[key].is_array()) continue;
        for (const Json& one : document[key]) {
            if (!one.is_object() || !one.contains("uri") || !one["uri"].is_string()) continue;
            const auto& uri = one["uri"].get_ref<const std::string&>();
            if (!uri.starts_with("data:")) add_inside(files, model.parent_path(), uri, Reference::uri);
        }
    }
}

void add_library(const fs::path& model, const fs::path& library, std::vector<fs::path>& files) {
    files.push_back(library);
    std::vector<std::string> warnings;
    const auto text = detail::read_file(library);
    for (const detail::MtlMaterial& material : detail::read_mtl(text, library.string(), warnings)) {
        for (const auto* texture : {&material.color, &material.alpha, &material.emissive, &material.normal}) {
            if (texture->file.empty()) continue;
            const fs::path image =
                library.parent_path().lexically_relative(fs::canonical(model.parent_path())) / texture->file;
            add_inside(files, model.parent_path(), image.generic_string(), Reference::file_name);
        }
    }
}

/// Of a line that begins with mtllib: the whole rest, and every word.
void add_libraries(const fs::path& model, std::string_view rest, std::vector<fs::path>& libraries) {
    const auto skip_blanks = [&rest] {
        rest.remove_prefix(std::min(rest.find_first_not_of(" \t"), rest.size()));
    };
    skip_blanks();
    rest = rest.substr(0, rest.find_last_not_of(" \t\r") + 1);
    add_inside(libraries, model.parent_path(), std::string(rest), Reference::file_name);
    while (!rest.empty()) {
        const std::string_view word = rest.substr(0, rest.find_first_of(" \t"));
        add_inside(libraries, model.parent_path(), std::string(word), Reference::file_name);
        rest.remove_prefix(word.size());
        skip_blanks();
    }
}

void add_obj_files(const fs::path& model, std::vector<fs::path>& files) {
    // Line by line: this is done before memory is asked for.
    std::ifstream in(model, std::ios::binary);
    std::vector<fs::path> libraries;
    for (std::string line; std::getline(in, line);) {
        const std::size_t first = line.find_first_not_of(" \t");
        if (first != std::string::npos && line.compare(first, 6, "mtllib") == 0)
            add_libraries(model, std::string_view(line).substr(first + 6), libraries);
    }
    for (const fs::path& library : libraries) add_library(model, library, files);
}

}  // namespace

std::vector<fs::path> referred_files(const fs::path& model) {
    std::vector<fs::path> files;
    const std::string ending = lower_ending(model);
    try {
        if (ending == ".obj") add_obj_files(model, files);
        if (ending == ".glb") add_gltf_files(model, glb_json(model), files);
        if (ending == ".gltf") {
            const auto bytes = detail::read_file(model);
            add_gltf_files(model, {reinterpret_cast<const char*>(bytes.data()), bytes.size()}, files);
        }
    } catch (const InputError&) {
    } catch (const fs::filesystem_error&) {
    }
    return files;
}

std::string stamp_of(const std::vector<fs::path>& files) {
    std::string text;
    for (const fs::path& file : files) {
        struct stat status = {};
        if (::stat(file.c_str(), &status) != 0) continue;
        for (const auto number :
             {static_cast<std::int64_t>(status.st_size), static_cast<std::int64_t>(status.st_mtim.tv_sec),
              static_cast<std::int64_t>(status.st_mtim.tv_nsec)}) {
            if (!text.empty()) text += ' ';
            text += std::to_string(number);
        }
    }
    return text;
}

std::uint64_t bytes_of(const std::vector<fs::path>& files) {
    std::uint64_t sum = 0;
    for (const fs::path& file : files) {
        struct stat status = {};
        if (::stat(file.c_str(), &status) == 0) sum += static_cast<std::uint64_t>(status.st_size);
    }
    return sum;
}

}  // namespace faqem::tool
