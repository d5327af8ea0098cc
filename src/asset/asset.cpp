#include "faqem/asset.hpp"

#include <string_view>

#include "asset/file_format.hpp"
#include "asset/gltf/gltf.hpp"
#include "asset/gltf/scene.hpp"
#include "asset/io/file.hpp"
#include "asset/io/set_folder.hpp"
#include "asset/model_files.hpp"
#include "faqem/error.hpp"

namespace faqem {

namespace fs = std::filesystem;
using detail::FormatUse;

namespace {

// Warns of a result that was made for a format that can hold other things. Loaded assets have files, results have none.
void add_format_warning(const Asset& result, const fs::path& file, std::vector<std::string>& warnings) {
    if (result.format == ModelFormat::automatic || result.file_bytes > 0) return;
    const detail::FileFormat& made_for = detail::result_format(result.format, result.format);
    const detail::FileFormat& saved = detail::written_format(file);
    if (&saved == &made_for || (saved.is_gltf && made_for.is_gltf)) return;
    warnings.push_back("the result was made for " + std::string(made_for.extension) +
                       " files; set the option format to " + std::string(saved.extension.substr(1)) +
                       ", and it is made for what " + std::string(saved.extension) + " files can hold");
}

}  // namespace

Asset load(const fs::path& file) {
    detail::check_completely_replaced(file);  // a file of the set may not exist yet
    std::error_code error;
    const fs::file_status status = fs::status(file, error);
    if (!fs::exists(status)) {
        const std::string name = file.string();
        const bool is_no_path = name == "-" || name.find("://") != std::string::npos;
        throw ReadError(name, "",
                        is_no_path ? "only files are read, no URLs and no standard input" : "no such file");
    }
    if (!fs::is_regular_file(status)) throw ReadError(file.string(), "", "is not a regular file");
    detail::check_beginning(file);
    const detail::FileFormat* format = detail::format_of_file(file);
    if (format && format->read) {
        Asset asset = format->read(detail::read_file(file), file);
        asset.format = format->format;
        std::vector<fs::path> files = detail::referenced_files(file, detail::References::readable);
        files.push_back(file);
        asset.file_bytes = detail::total_file_size(files);
        return asset;
    }
    throw UnsupportedError(
        file.string(), "",
        "has an unknown format; supported are " + listed_extensions(FormatUse::read, "and"));
}

std::vector<std::string> save(const Asset& asset, const fs::path& file, Overwrite overwrite) {
    detail::EncodedModel model = detail::encode_model(asset, file);
    add_format_warning(asset, file, model.losses);
    detail::write_model(model, file.parent_path(), overwrite);
    return std::move(model.losses);
}

std::vector<std::uint8_t> to_glb(const Asset& asset, std::vector<std::string>* losses) {
    detail::EncodedModel model = detail::encode_gltf(asset, "model.glb");
    add_format_warning(asset, "model.glb", model.losses);
    if (losses) *losses = std::move(model.losses);
    const std::span<const std::uint8_t> bytes = model.files.back().bytes;
    return {bytes.begin(), bytes.end()};
}

Asset from_glb(std::span<const std::uint8_t> bytes) {
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    if (!text.starts_with("glTF"))
        throw InputError("", "", text.empty() ? "is empty" : "is not a GLB file, which begins with 'glTF'");
    Asset asset = detail::read_gltf(bytes, {});
    asset.format = ModelFormat::glb;
    asset.file_bytes = bytes.size();
    return asset;
}

std::vector<Instance> instances(const Asset& asset) {
    return detail::instances_at(asset, detail::placed_nodes(detail::source_document(asset).document));
}

}  // namespace faqem
