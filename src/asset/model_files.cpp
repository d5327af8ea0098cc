#include "asset/model_files.hpp"

#include <map>
#include <set>
#include <string>
#include <string_view>

#include "asset/file_format.hpp"
#include "asset/formats/formats.hpp"
#include "asset/io/file.hpp"
#include "faqem/error.hpp"

namespace faqem::detail {
namespace {

namespace fs = std::filesystem;

/// Returns the part of a file name that follows the stem of a model if the file may be one of its images, with
/// the extension in lower case: `_12.png` of `urn_12.PNG`. Empty if the name has no such end.
std::string image_suffix(const fs::path& file) {
    const std::string name = file.stem().string(), extension = lower_case_extension(file);
    const std::size_t line = name.rfind('_');
    if (line == std::string::npos || extension.empty()) return {};
    const std::string_view number = std::string_view(name).substr(line + 1);
    if (number.empty() || number.find_first_not_of("0123456789") != std::string_view::npos) return {};
    if (number.size() > 1 && number[0] == '0') return {};  // numbers are written without leading zeros
    return name.substr(line) + extension;
}

std::set<std::string> image_suffixes(const fs::path& folder) {
    std::set<std::string> suffixes;
    std::error_code error;
    for (const std::string& name : file_names(folder, error))
        if (const std::string suffix = image_suffix(name); !suffix.empty()) suffixes.insert(suffix);
    if (error && error != std::errc::no_such_file_or_directory)
        throw WriteError(folder.string() +
                         ": cannot list the files that would be overwritten: " + error.message());
    return suffixes;
}

}  // namespace

std::vector<fs::path> referenced_files(const fs::path& model, References which) {
    ReferenceList files(model, which);
    std::error_code error;
    if (!fs::is_regular_file(model, error)) return {};  // opening a pipe would block
    try {
        // A library is no model, but has references of its own.
        if (lower_case_extension(model) == library_file_name(""))
            list_library_references(model, files);
        else if (const FileFormat* format = format_of_file(model); format && format->list_references)
            format->list_references(model, files);
    } catch (const fs::filesystem_error&) {  // the model was removed
    }
    return files.finish();
}

std::vector<fs::path> existing_side_files(const std::vector<fs::path>& models) {
    std::vector<fs::path> found;
    std::map<fs::path, std::set<std::string>> suffixes;  // by folder
    for (const fs::path& model : models) {
        const FileFormat* format = format_by_name(model);
        if (format == nullptr || !(format->side_file.name || format->has_image_files)) continue;
        const std::string stem = model.stem().string();
        const fs::path folder = model.parent_path();
        const auto add_if_exists = [&](const std::string& name) {
            std::error_code error;
            if (fs::exists(folder / name, error)) found.push_back(folder / name);
        };
        if (format->side_file.name) add_if_exists(format->side_file.name(stem));
        if (!format->has_image_files) continue;
        const auto [in_folder, is_new] = suffixes.try_emplace(folder);
        if (is_new) in_folder->second = image_suffixes(folder);
        // The stem is not compared with the names in the folder: only the file system knows which are equal.
        for (const std::string& suffix : in_folder->second) add_if_exists(stem + suffix);
    }
    return found;
}

}  // namespace faqem::detail
