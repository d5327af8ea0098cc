#include "cli/files/protected_files.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <system_error>
#include <utility>

#include "asset/file_format.hpp"
#include "asset/io/file.hpp"
#include "asset/io/file_set.hpp"
#include "asset/model_files.hpp"
#include "faqem/error.hpp"

namespace faqem::cli {

namespace {

namespace fs = std::filesystem;

using detail::file_id, detail::FileId;

struct ProtectedFiles {
    std::vector<fs::path> unread_inputs;
    std::map<FileId, fs::path> inputs;
    std::map<FileId, fs::path> users;  ///< by referenced file, the first input that refers to it
};
ProtectedFiles protected_files;

void read_inputs() {
    for (const fs::path& input : std::exchange(protected_files.unread_inputs, {})) {
        if (const std::optional<FileId> id = file_id(input)) protected_files.inputs.emplace(*id, input);
        for (const fs::path& file : detail::referenced_files(input, detail::References::all))
            if (const std::optional<FileId> id = file_id(file)) protected_files.users.emplace(*id, input);
    }
}

/// The check of write_output() and save().
void check_written_files(std::span<const fs::path> files) {
    for (const fs::path& file : files) check_unprotected(file);
    check_side_files_unshared(files);
}

void check_owner(const fs::path& owner, std::span<const fs::path> files) {
    std::error_code error;
    // Files that do not exist are never the same.
    const auto same_as = [&](const fs::path& other) {
        return std::ranges::find_if(files,
                                    [&](const fs::path& one) { return fs::equivalent(one, other, error); });
    };
    if (!fs::is_regular_file(owner, error) || same_as(owner) != files.end()) return;
    for (const fs::path& needed : detail::referenced_files(owner, detail::References::all))
        if (const auto file = same_as(needed); file != files.end())
            throw WriteError(file->string() + ": is needed by " + owner.string() +
                             "; choose another output name");
}

}  // namespace

void protect_input(const fs::path& input) {
    protected_files.unread_inputs.push_back(input);
    detail::set_write_check(check_written_files);
}

void check_unprotected(const fs::path& file) {
    const std::optional<FileId> id = file_id(file);
    if (!id) return;
    read_inputs();
    const auto& [unread, inputs, users] = protected_files;
    if (const auto input = inputs.find(*id); input != inputs.end())
        throw OptionError(file.string() + ": is the same file as the input " + input->second.string() +
                          "; choose another output name");
    if (const auto user = users.find(*id); user != users.end())
        throw WriteError(file.string() + ": is needed by the input " + user->second.string() +
                         "; choose another output name");
}

void check_models_unprotected(const std::vector<fs::path>& models) {
    for (const fs::path& model : models) check_unprotected(model);
    for (const fs::path& file : detail::existing_side_files(models)) check_unprotected(file);
}

void check_side_files_unshared(std::span<const fs::path> files) {
    for (const fs::path& model : files) {
        const detail::FileFormat* format = detail::format_by_name(model);
        if (format == nullptr || !format->has_image_files) continue;
        const bool replaces_side_file = std::ranges::any_of(files, [&](const fs::path& file) {
            std::error_code error;
            return file != model && fs::exists(file, error);
        });
        if (!replaces_side_file) continue;
        const std::string stem = model.stem().string();
        for (const detail::FileFormat& other : detail::file_formats()) {
            if (!other.has_image_files) continue;
            check_owner(model.parent_path() / (stem + std::string(other.extension)), files);
            if (other.side_file.name) check_owner(model.parent_path() / other.side_file.name(stem), files);
        }
    }
}

}  // namespace faqem::cli
