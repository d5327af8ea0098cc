#include "asset/io/file_format.hpp"

#include <algorithm>
#include <array>
#include <fstream>
#include <string_view>

namespace faqem::detail {
namespace {

namespace fs = std::filesystem;

/// Detects the format from the first 64 bytes. A leading brace is taken as JSON glTF. OBJ and STL have no
/// signature and give Format::unknown.
Format format_by_content(const fs::path& file) {
    std::array<char, 64> head = {};
    std::ifstream in(file, std::ios::binary);
    in.read(head.data(), head.size());
    std::string_view text(head.data(), static_cast<std::size_t>(in.gcount()));
    if (text.substr(0, 4) == "glTF") return Format::gltf;
    if (text.substr(0, 4) == "ply\n" || text.substr(0, 4) == "ply\r") return Format::ply;
    text.remove_prefix(std::min(text.find_first_not_of(" \t\r\n"), text.size()));
    if (text.substr(0, 1) == "{") return Format::gltf;
    return text.substr(0, 3) == "OFF" ? Format::off : Format::unknown;
}

}  // namespace

std::string lower_case_extension(const fs::path& file) {
    std::string extension = file.extension().string();
    for (char& c : extension)
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    return extension;
}

Format format_by_name(const fs::path& file) {
    const std::string extension = lower_case_extension(file);
    if (extension == ".glb" || extension == ".gltf") return Format::gltf;
    if (extension == ".obj") return Format::obj;
    if (extension == ".ply") return Format::ply;
    if (extension == ".stl") return Format::stl;
    return extension == ".off" ? Format::off : Format::unknown;
}

Format format_of_file(const fs::path& file) {
    const Format format = format_by_content(file);
    return format == Format::unknown ? format_by_name(file) : format;
}

}  // namespace faqem::detail
