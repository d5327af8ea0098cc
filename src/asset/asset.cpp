#include "faqem/asset.hpp"

#include "asset/file_format.hpp"
#include "asset/gltf/gltf.hpp"
#include "asset/gltf/pose.hpp"
#include "asset/io/recovery.hpp"
#include "asset/scene/rest_pose.hpp"
#include "faqem/error.hpp"

namespace faqem {

namespace fs = std::filesystem;
using detail::FormatUse;

Asset load(const fs::path& file) {
    detail::check_completely_replaced(file);  // a file of the set may not exist yet
    std::error_code error;
    const fs::file_status status = fs::status(file, error);
    if (!fs::exists(status)) throw ReadError(file.string(), "", "no such file");
    if (!fs::is_regular_file(status)) throw ReadError(file.string(), "", "is not a regular file");
    const detail::FileFormat* format = detail::format_of_file(file);
    if (format && format->read) return format->read(file);
    throw UnsupportedError(
        file.string(), "",
        "has an unknown format; supported are " + listed_extensions(FormatUse::read, "and"));
}

std::vector<std::string> save(const Asset& asset, const fs::path& file, Overwrite overwrite) {
    const detail::FileFormat* format = detail::format_by_name(file);
    if (format && format->write) return format->write(asset, file, overwrite);
    throw UnsupportedError(
        file.string(), "",
        "cannot be written: the file name must end in " + listed_extensions(FormatUse::write));
}

std::vector<Instance> instances(const Asset& asset) {
    if (asset.source) return detail::gltf_instances(asset);
    std::vector<Instance> all;
    for (Index i = 0; i < asset.parts.size(); ++i)
        all.push_back({i, {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}});
    return all;
}

std::vector<detail::PosedInstance> detail::posed_instances(const Asset& asset) {
    if (asset.source) return detail::gltf_posed_instances(asset);
    std::vector<PosedInstance> all;
    for (const Instance& instance : instances(asset)) all.push_back({instance.part, instance.transform});
    return all;
}

}  // namespace faqem
