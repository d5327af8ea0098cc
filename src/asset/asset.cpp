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
    detail::EncodedModel model = detail::encode_model(asset, file);
    detail::write_model(model, file.parent_path(), overwrite);
    return std::move(model.losses);
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
