#include "cli/side_file_owners.hpp"

#include <algorithm>
#include <system_error>
#include <vector>

#include "asset/io/file_format.hpp"
#include "asset/io/side_files.hpp"
#include "cli/referenced_files.hpp"
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
    for (const fs::path& needed : referenced_files(owner, References::all))
        if (const fs::path* file = find_same(files, needed))
            throw WriteError(file->string() + ": is needed by " + owner.string() +
                             "; choose another output name");
}

}  // namespace

void check_side_files_unshared(std::span<const fs::path> files) {
    for (const fs::path& model : files) {
        const std::string extension = detail::lower_case_extension(model);
        if (extension != ".gltf" && extension != ".obj") continue;
        const bool replaces_side_file = std::any_of(files.begin(), files.end(), [&](const fs::path& file) {
            std::error_code error;
            return file != model && fs::exists(file, error);
        });
        if (!replaces_side_file) continue;
        const std::string stem = model.stem().string();
        for (const std::string& name : {stem + ".gltf", stem + ".obj", detail::library_file_name(stem)})
            check_owner(model.parent_path() / name, files);
    }
}

}  // namespace faqem::cli
