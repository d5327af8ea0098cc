#include "faqem/asset.hpp"

#include "asset/formats/obj.hpp"
#include "asset/formats/off.hpp"
#include "asset/formats/ply.hpp"
#include "asset/formats/stl.hpp"
#include "asset/gltf/gltf.hpp"
#include "asset/io/file_format.hpp"
#include "asset/io/recovery.hpp"
#include "faqem/error.hpp"

namespace faqem {

namespace fs = std::filesystem;
using detail::Format;

Asset load(const fs::path& file) {
    detail::check_completely_replaced(file);  // a file of the set may not exist yet
    std::error_code error;
    const fs::file_status status = fs::status(file, error);
    if (!fs::exists(status)) throw ReadError(file.string(), "", "no such file");
    if (!fs::is_regular_file(status)) throw ReadError(file.string(), "", "is not a regular file");
    switch (detail::format_of_file(file)) {
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
    switch (detail::format_by_name(file)) {
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
