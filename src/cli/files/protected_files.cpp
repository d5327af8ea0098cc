#include "cli/files/protected_files.hpp"

#include <sys/stat.h>

#include <map>
#include <mutex>
#include <optional>
#include <span>
#include <utility>

#include "asset/io/file_set.hpp"
#include "asset/model_files.hpp"
#include "cli/files/side_file_owners.hpp"
#include "faqem/error.hpp"

namespace faqem::cli {

namespace {

namespace fs = std::filesystem;

/// Device and inode.
using FileId = std::pair<dev_t, ino_t>;

/// Returns nothing if the file does not exist. Links are followed.
std::optional<FileId> file_id(const fs::path& file) {
    struct stat status = {};
    if (::stat(file.c_str(), &status) != 0) return std::nullopt;
    return FileId(status.st_dev, status.st_ino);
}

class ProtectedFiles {
public:
    void add_input(const fs::path& input) {
        const std::lock_guard guard(mutex_);
        unread_inputs_.push_back(input);
    }

    void check(const fs::path& file) {
        const std::optional<FileId> id = file_id(file);
        if (!id) return;
        const std::lock_guard guard(mutex_);
        read_inputs();
        if (const auto input = inputs_.find(*id); input != inputs_.end())
            throw OptionError(file.string() + ": is the same file as the input " + input->second.string() +
                              "; choose another output name");
        if (const auto user = users_.find(*id); user != users_.end())
            throw WriteError(file.string() + ": is needed by the input " + user->second.string() +
                             "; choose another output name");
    }

private:
    void read_inputs() {
        for (const fs::path& input : std::exchange(unread_inputs_, {})) {
            if (const std::optional<FileId> id = file_id(input)) inputs_.emplace(*id, input);
            for (const fs::path& file : detail::referenced_files(input, detail::References::all))
                if (const std::optional<FileId> id = file_id(file)) users_.emplace(*id, input);
        }
    }

    std::mutex mutex_;
    std::vector<fs::path> unread_inputs_;
    std::map<FileId, fs::path> inputs_;
    std::map<FileId, fs::path> users_;  // by referenced file, the first input that refers to it
};

ProtectedFiles& protected_files() {
    static ProtectedFiles files;
    return files;
}

/// The check of write_output() and save().
void check_written_files(std::span<const fs::path> files) {
    for (const fs::path& file : files) check_unprotected(file);
    check_side_files_unshared(files);
}

}  // namespace

void protect_input(const fs::path& input) {
    protected_files().add_input(input);
    detail::set_write_check(check_written_files);
}

void check_unprotected(const fs::path& file) { protected_files().check(file); }

void check_models_unprotected(const std::vector<fs::path>& models) {
    for (const fs::path& model : models) check_unprotected(model);
    for (const fs::path& file : detail::existing_side_files(models)) check_unprotected(file);
}

}  // namespace faqem::cli
