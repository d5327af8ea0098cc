#include "cli/referenced_files.hpp"

#include <sys/stat.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <fstream>
#include <string_view>

#include "asset/formats/mtl.hpp"
#include "asset/io/file.hpp"
#include "cli/json.hpp"
#include "cli/output_file.hpp"
#include "faqem/error.hpp"

namespace faqem::cli {

namespace {

namespace fs = std::filesystem;
using detail::ReferenceSyntax;

void add_referenced_file(std::vector<fs::path>& files, const fs::path& folder, const std::string& reference,
                         ReferenceSyntax kind) {
    try {
        fs::path file = detail::resolve_inside(folder, reference, kind);
        if (std::find(files.begin(), files.end(), file) == files.end()) files.push_back(std::move(file));
    } catch (const InputError&) {
    }
}

/// Returns the JSON of a .glb file: the first chunk, which follows a file header of 12 bytes and a chunk
/// header of 8 bytes. Empty if the file is not a GLB file.
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

void add_gltf_references(const fs::path& model, std::string_view text, std::vector<fs::path>& files) {
    const Json document = Json::parse(text, nullptr, false);
    for (const char* key : {"buffers", "images"}) {
        if (!document.is_object() || !document.contains(key) || !document[key].is_array()) continue;
        for (const Json& one : document[key]) {
            if (!one.is_object() || !one.contains("uri") || !one["uri"].is_string()) continue;
            const auto& uri = one["uri"].get_ref<const std::string&>();
            if (!uri.starts_with("data:"))
                add_referenced_file(files, model.parent_path(), uri, ReferenceSyntax::uri);
        }
    }
}

void add_mtl_references(const fs::path& model, const fs::path& mtl_file, std::vector<fs::path>& files) {
    files.push_back(mtl_file);
    std::vector<std::string> warnings;
    const auto text = detail::read_file(mtl_file);
    for (const detail::MtlMaterial& material : detail::read_mtl(text, mtl_file.string(), warnings)) {
        for (const auto* texture : {&material.color, &material.alpha, &material.emissive, &material.normal}) {
            if (texture->file.empty()) continue;
            const fs::path image =
                mtl_file.parent_path().lexically_relative(fs::canonical(model.parent_path())) / texture->file;
            add_referenced_file(files, model.parent_path(), image.generic_string(),
                                ReferenceSyntax::file_name);
        }
    }
}

/// Adds the library files of an mtllib line. The rest of the line is tried as one name with spaces, and each
/// of its words as a name.
void add_mtl_files(const fs::path& model, std::string_view rest, std::vector<fs::path>& mtl_files) {
    const auto skip_blanks = [&rest] {
        rest.remove_prefix(std::min(rest.find_first_not_of(" \t"), rest.size()));
    };
    skip_blanks();
    rest = rest.substr(0, rest.find_last_not_of(" \t\r") + 1);
    add_referenced_file(mtl_files, model.parent_path(), std::string(rest), ReferenceSyntax::file_name);
    while (!rest.empty()) {
        const std::string_view word = rest.substr(0, rest.find_first_of(" \t"));
        add_referenced_file(mtl_files, model.parent_path(), std::string(word), ReferenceSyntax::file_name);
        rest.remove_prefix(word.size());
        skip_blanks();
    }
}

void add_obj_references(const fs::path& model, std::vector<fs::path>& files) {
    // Read line by line, because this runs before memory is reserved for the model.
    std::ifstream in(model, std::ios::binary);
    std::vector<fs::path> mtl_files;
    for (std::string line; std::getline(in, line);) {
        const std::size_t first = line.find_first_not_of(" \t");
        if (first != std::string::npos && line.compare(first, 6, "mtllib") == 0)
            add_mtl_files(model, std::string_view(line).substr(first + 6), mtl_files);
    }
    for (const fs::path& mtl_file : mtl_files) add_mtl_references(model, mtl_file, files);
}

}  // namespace

std::vector<fs::path> referenced_files(const fs::path& model) {
    std::vector<fs::path> files;
    const std::string extension = lower_case_extension(model);
    try {
        if (extension == ".obj") add_obj_references(model, files);
        if (extension == ".glb") add_gltf_references(model, glb_json(model), files);
        if (extension == ".gltf") {
            const auto bytes = detail::read_file(model);
            add_gltf_references(model, {reinterpret_cast<const char*>(bytes.data()), bytes.size()}, files);
        }
    } catch (const InputError&) {
    } catch (const fs::filesystem_error&) {
    }
    return files;
}

std::string modification_stamp(const std::vector<fs::path>& files) {
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

std::uint64_t total_file_size(const std::vector<fs::path>& files) {
    std::uint64_t sum = 0;
    for (const fs::path& file : files) {
        struct stat status = {};
        if (::stat(file.c_str(), &status) == 0) sum += static_cast<std::uint64_t>(status.st_size);
    }
    return sum;
}

}  // namespace faqem::cli
