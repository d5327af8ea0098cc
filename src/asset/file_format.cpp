#include "asset/file_format.hpp"

#include <algorithm>
#include <array>
#include <fstream>

#include "asset/formats/obj.hpp"
#include "asset/formats/off.hpp"
#include "asset/formats/ply.hpp"
#include "asset/formats/ply_header.hpp"
#include "asset/formats/stl.hpp"
#include "asset/gltf/gltf.hpp"
#include "asset/gltf/write/levels.hpp"
#include "asset/io/file_names.hpp"
#include "faqem/error.hpp"

namespace faqem::detail {
namespace {

namespace fs = std::filesystem;

bool is_glb(std::string_view head, std::string_view /*text*/) { return head.starts_with("glTF"); }
bool is_json(std::string_view /*head*/, std::string_view text) { return text.starts_with('{'); }
bool is_off(std::string_view /*head*/, std::string_view text) { return text.starts_with("OFF"); }
bool is_ply(std::string_view head, std::string_view /*text*/) {
    return head.starts_with("ply\n") || head.starts_with("ply\r");
}

const std::array<FileFormat, 7> formats = {{
    {.extension = ".glb",
     .format = ModelFormat::glb,
     .has_signature = is_glb,
     .read = read_gltf,
     .encode = encode_gltf,
     .encode_levels = encode_gltf_levels,
     .list_references = list_gltf_references,
     .is_gltf = true,
     .document_memory = gltf_document_memory,
     .decoding_memory = gltf_decoding_memory,
     .min_bytes_per_face = 15},
    {.extension = ".gltf",
     .format = ModelFormat::gltf,
     .has_signature = is_json,
     .read = read_gltf,
     .encode = encode_gltf,
     .encode_levels = encode_gltf_levels,
     .list_references = list_gltf_references,
     .side_file = {.name = buffer_file_name, .is_always_written = true},
     .has_image_files = true,
     .is_gltf = true,
     .document_memory = gltf_document_memory,
     .decoding_memory = gltf_decoding_memory,
     .min_bytes_per_face = 15},
    {.extension = ".vrm",  // a GLB with the extension VRM or VRMC_vrm
     .format = ModelFormat::glb,
     .read = read_gltf,
     .encode = encode_gltf,
     .encode_levels = encode_gltf_levels,
     .list_references = list_gltf_references,
     .is_gltf = true,
     .min_bytes_per_face = 15},
    {.extension = ".obj",
     .format = ModelFormat::obj,
     .read = read_obj,
     .encode = encode_obj,
     .list_references = list_obj_references,
     .is_read_for_references = true,
     .side_file = {.name = library_file_name},
     .has_image_files = true,
     .min_bytes_per_face = 28,
     .bare_bake = Bake::none,
     .keeps_plain_parts = true},
    {.extension = ".ply",
     .format = ModelFormat::ply,
     .has_signature = is_ply,
     .read = read_ply,
     .encode = encode_ply,
     .list_references = list_ply_references,
     .min_bytes_per_face = 15,
     .bake = Bake::vertex,
     .bare_bake = Bake::none,
     .keeps_plain_parts = true},
    {.extension = ".stl",
     .format = ModelFormat::stl,
     .read = read_stl,
     .encode = encode_stl,
     .min_bytes_per_face = 50,
     .bake = Bake::none,
     .bare_bake = Bake::none,
     .holds_normals = false},
    {.extension = ".off", .has_signature = is_off, .read = read_off, .min_bytes_per_face = 28},
}};

bool has_use(const FileFormat& format, FormatUse use) {
    switch (use) {
        case FormatUse::read:
            return format.read != nullptr;
        case FormatUse::write:
            return format.encode != nullptr;
        case FormatUse::write_levels:
            break;
    }
    return format.encode_levels != nullptr;
}

}  // namespace

std::span<const FileFormat> file_formats() { return formats; }

const FileFormat* format_by_name(const fs::path& file) {
    const std::string extension = lower_case_extension(file);
    for (const FileFormat& format : formats)
        if (format.extension == extension) return &format;
    return nullptr;
}

const FileFormat* format_of_file(const fs::path& file) {
    std::array<char, 64> bytes = {};
    std::ifstream in(file, std::ios::binary);
    in.read(bytes.data(), bytes.size());
    const std::string_view head(bytes.data(), static_cast<std::size_t>(in.gcount()));
    const std::string_view text = head.substr(std::min(head.find_first_not_of(" \t\r\n"), head.size()));
    for (const FileFormat& format : formats)
        if (format.has_signature && format.has_signature(head, text)) return &format;
    return format_by_name(file);
}

const FileFormat& written_format(const fs::path& file) {
    const FileFormat* format = format_by_name(file);
    if (format && format->encode) return *format;
    throw UnsupportedError(
        file.string(), "",
        "cannot be written: the file name must end in " + listed_extensions(FormatUse::write));
}

const FileFormat& result_format(ModelFormat wanted, ModelFormat loaded) {
    const ModelFormat known = wanted == ModelFormat::automatic ? loaded : wanted;
    const auto found = std::find_if(formats.begin(), formats.end(),
                                    [&](const FileFormat& format) { return format.format == known; });
    return known == ModelFormat::automatic || found == formats.end() ? formats.front() : *found;
}

EncodedModel encode_model(const Asset& asset, const fs::path& file) {
    return written_format(file).encode(asset, file);
}

std::vector<std::string_view> format_extensions(FormatUse use) {
    std::vector<std::string_view> found;
    for (const FileFormat& format : formats)
        if (has_use(format, use)) found.push_back(format.extension);
    return found;
}

std::string listed_extensions(FormatUse use, std::string_view conjunction) {
    const std::vector<std::string_view> all = format_extensions(use);
    const std::string last = std::string(" ").append(conjunction).append(" ");
    std::string text;
    for (std::size_t i = 0; i < all.size(); ++i) {
        if (i > 0) text += i + 1 < all.size() ? ", " : last;
        text += all[i];
    }
    return text;
}

}  // namespace faqem::detail
