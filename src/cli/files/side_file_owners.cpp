#include "cli/files/side_file_owners.hpp"

#include <algorithm>
#include <system_error>

#include "asset/file_format.hpp"
#include "asset/model_files.hpp"
#include "faqem/error.hpp"

namespace faqem::cli {

namespace {

namespace fs = std::filesystem;

/// Returns the first of the files that is the same as `file`, or null. Files that do not exist are never the
/// same.
const fs::path* find_same(std::span<const fs::path> files, const fs::path& file) {
    for (const fs::path& one : files) {
        std::error_code error;
        if (fs::equivalent(one, file, error)) return &one;
    }
    return nullptr;
}

void check_owner(const fs::path& owner, std::span<const fs::path> files) {
    std::error_code error;
    if (!fs::is_regular_file(owner, error) || find_same(files, owner)) return;
    for (const fs::path& needed : detail::referenced_files(owner, detail::References::all))
        if (const fs::path* file = find_same(files, needed))
            throw WriteError(file->string() + ": is needed by " + owner.string() +
                             "; choose another output name");
}

}  // namespace

void check_side_files_unshared(std::span<const fs::path> files) {
    for (const fs::path& model : files) {
        const detail::FileFormat* format = detail::format_by_name(model);
        if (format == nullptr || !format->has_image_files) continue;
        const bool replaces_side_file = std::any_of(files.begin(), files.end(), [&](const fs::path& file) {
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
