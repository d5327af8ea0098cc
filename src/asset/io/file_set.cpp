#include "asset/io/file_set.hpp"

#include <algorithm>
#include <cerrno>
#include <iterator>
#include <set>
#include <system_error>
#include <utility>

#include "asset/io/encoded_model.hpp"
#include "asset/io/set_folder.hpp"
#include "asset/io/write_all.hpp"
#include "faqem/error.hpp"

namespace faqem::detail {
namespace {

namespace fs = std::filesystem;

fs::path parent_of(const fs::path& file) { return file.has_parent_path() ? file.parent_path() : "."; }

PendingFile write_temporary_file(const FileContent& content, Overwrite overwrite) {
    fs::path target = content.file;
    struct stat old = {};
    const bool exists = ::stat(target.c_str(), &old) == 0;
    if (!exists && errno != ENOENT) fail_write(target, "write", errno);
    if (exists && !S_ISREG(old.st_mode)) throw WriteError(target.string() + ": is not a regular file");
    if (exists && overwrite == Overwrite::no) fail_write(target, "write without overwriting", EEXIST);
    if (exists) target = fs::canonical(target);

    std::error_code error;
    const fs::path folder = fs::canonical(parent_of(target), error);
    if (error) fail_write(content.file, "open its folder", error.value());
    const mode_t mode = exists ? old.st_mode & 07777 : 0666;
    TemporaryFile temporary(folder / target.filename(), mode & 0666, content.file);
    const int file = temporary.file();
    if (!write_all(file, content.bytes)) fail_write(content.file, "write", errno);
    if (exists && ::fchmod(file, mode) != 0) fail_write(content.file, "set the permissions", errno);
    if (::fsync(file) != 0) fail_write(content.file, "write to the disk", errno);
    return {folder, target.filename(), std::move(temporary), overwrite};
}

WriteCheck write_check = nullptr;
thread_local FileSet* collecting_set = nullptr;

}  // namespace

void set_write_check(WriteCheck check) { write_check = check; }

void FileSet::add(std::span<const FileContent> files, Overwrite overwrite) {
    std::vector<fs::path> paths;
    for (const FileContent& content : files) paths.push_back(content.file);
    if (write_check) write_check(paths);
    std::set<fs::path> folders, targets;
    for (const fs::path& path : paths) {
        std::error_code error;
        const fs::path linked = fs::canonical(path, error);
        folders.insert(parent_of(error ? path : linked));
    }
    for (const PendingFile& file : files_) targets.insert(file.target());
    std::vector<PendingFile> pending;
    try {
        for (const fs::path& folder : folders) recover_folder(folder);
        for (const FileContent& content : files) {
            pending.push_back(write_temporary_file(content, overwrite));
            if (!targets.insert(pending.back().target()).second)
                throw WriteError(content.file.string() + ": is the name of two files");
        }
    } catch (const fs::filesystem_error& error) {
        throw WriteError(error.path1().string() + ": cannot write: " + error.code().message());
    }
    std::move(pending.begin(), pending.end(), std::back_inserter(files_));
}

void FileSet::commit(void (*completed)() noexcept) {
    replace_files(files_, completed);
    files_.clear();
}

CollectWrites::CollectWrites(FileSet& set) { collecting_set = &set; }

CollectWrites::~CollectWrites() { collecting_set = nullptr; }

void write_files(std::span<const FileContent> files, Overwrite overwrite) {
    if (collecting_set) return collecting_set->add(files, overwrite);
    FileSet set;
    set.add(files, overwrite);
    set.commit();
}

void write_file(const fs::path& file, std::span<const std::uint8_t> bytes, Overwrite overwrite) {
    const FileContent content{file, bytes};
    write_files({&content, 1}, overwrite);
}

void write_model(const EncodedModel& model, const fs::path& folder, Overwrite overwrite) {
    std::vector<FileContent> contents;
    for (const EncodedFile& file : model.files) contents.push_back({folder / file.name, file.bytes});
    write_files(contents, overwrite);
}

}  // namespace faqem::detail
