#include "faqem/asset.hpp"

#include <algorithm>
#include <array>
#include <fstream>
#include <string_view>

#include "asset/formats/obj.hpp"
#include "asset/formats/off.hpp"
#include "asset/formats/ply.hpp"
#include "asset/formats/stl.hpp"
#include "asset/gltf/gltf.hpp"
#include "faqem/error.hpp"

namespace faqem {
namespace {

namespace fs = std::filesystem;

enum class Format { unknown, gltf, obj, ply, stl, off };

std::string lower_extension(const fs::path& file) {
    std::string extension = file.extension().string();
    for (char& c : extension)
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    return extension;
}

Format format_by_name(const fs::path& file) {
    const std::string extension = lower_extension(file);
    if (extension == ".glb" || extension == ".gltf") return Format::gltf;
    if (extension == ".obj") return Format::obj;
    if (extension == ".ply") return Format::ply;
    if (extension == ".stl") return Format::stl;
    return extension == ".off" ? Format::off : Format::unknown;
}

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

Asset load(const fs::path& file) {
    std::error_code error;
    const fs::file_status status = fs::status(file, error);
    if (!fs::exists(status)) throw ReadError(file.string(), "", "no such file");
    if (!fs::is_regular_file(status)) throw ReadError(file.string(), "", "is not a regular file");
    Format format = format_by_content(file);
    if (format == Format::unknown) format = format_by_name(file);
    switch (format) {
        case Format::gltf:
            return detail::read_gltf(file);
        case Format::obj:
            return detail::read_obj(file);
        case Format::ply:
            return detail::read_ply(file);
        case Format::stl:
            return detail::read_stl(file);
        case Format::off:
            return detail::read_off(file);
        case Format::unknown:
            break;
    }
    throw UnsupportedError(file.string(), "",
                           "has an unknown format; supported are .glb, .gltf, .obj, .ply, .stl and .off");
}

std::vector<std::string> save(const Asset& asset, const fs::path& file, Overwrite overwrite) {
    switch (format_by_name(file)) {
        case Format::gltf:
            return detail::write_gltf(asset, file, overwrite);
        case Format::obj:
            return detail::write_obj(asset, file, overwrite);
        case Format::ply:
            return detail::write_ply(asset, file, overwrite);
        case Format::stl:
            return detail::write_stl(asset, file, overwrite);
        case Format::off:
        case Format::unknown:
            break;
    }
    throw UnsupportedError(file.string(), "",
                           "cannot be written: the file name must end in .glb, .gltf, .obj, .ply or .stl");
}

std::vector<Instance> instances(const Asset& asset) {
    if (asset.source) return detail::gltf_instances(asset);
    std::vector<Instance> all;
    for (Index i = 0; i < asset.parts.size(); ++i)
        all.push_back({i, {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}});
    return all;
}

}  // namespace faqem
