#include "asset/io/file_set.hpp"

#include <fcntl.h>

#include <cerrno>
#include <chrono>
#include <iterator>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <system_error>
#include <thread>
#include <utility>

#include "asset/io/encoded_model.hpp"
#include "asset/io/file.hpp"
#include "asset/io/set_folder.hpp"
#include "faqem/error.hpp"

namespace faqem::detail {
namespace {

namespace fs = std::filesystem;

#ifndef _WIN32
void require_temporary(const PendingFile& file) {
    if (file.temporary.is_removed()) fail_write(file.target(), "write", EINTR);
}

void replace_single_file(PendingFile& file, void (*completed)() noexcept) {
    const HeldSignals held;
    require_temporary(file);
    const Descriptor folder(::open(file.folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
    if (!folder) fail_write(file.target(), "open its folder", errno);
    const char* from = file.temporary.name();
    const std::string to = file.target().string();
    const bool renamed = file.overwrite == Overwrite::yes
                             ? ::rename(from, to.c_str()) == 0
                             : rename_if_absent(AT_FDCWD, from, AT_FDCWD, to.c_str());
    if (!renamed) fail_write(file.target(), "write", errno);
    file.temporary.release();
    if (!sync_folder(folder.get())) fail_write(file.target(), "sync its folder", errno);
    if (completed) completed();
}

/// A folder with files of a set.
struct ReplacedFolder {
    SetFolder set;
    Descriptor old_files, new_files;
    bool is_complete = false;  // the new files are on the disk

    bool rename_part(const char* from, const char* to) const {
        return ::renameat(set.set_file.get(), from, set.set_file.get(), to) == 0;
    }
};

/// Renames at least two files of a set in the given order while signals are held. Steps:
///
/// 1. The set folders of all folders are locked; other processes that write sets there wait.
/// 2. The old files get a second name there (a copy if the file system has no links), and the new files move there.
/// 3. When all of them are on the disk, the set is complete: from now on, a run that finds the folder without its lock
///    goes on with step 4.
/// 4. The files are renamed to their places, and the folders synced. On an error, the files are renamed back.
/// 5. The set folders are removed.
class Replacement {
public:
    explicit Replacement(std::span<PendingFile> files) : files_(files), has_old_(files.size(), false) {
        for (const PendingFile& file : files_) folders_.try_emplace(file.folder);
    }

    void run(void (*completed)() noexcept) {
        lock_folders();
        try {
            for (const PendingFile& file : files_) require_temporary(file);
            for (auto& [path, folder] : folders_) make_parts(folder);
            for (std::size_t i = 0; i < files_.size(); ++i) keep_old_file(i), stage_new_file(i);
            for (auto& [path, folder] : folders_) complete(folder);
            for (std::size_t i = 0; i < files_.size(); ++i) replace_file(i);
            for (const auto& [path, folder] : folders_) sync(folder.set.folder_file, folder);
        } catch (const WriteError& error) {
            if (restore_old_files()) throw;
            throw WriteError(std::string(error.what()) +
                             "; the files of the set cannot be restored either: the next faqem command that "
                             "writes to their folder completes the set");
        }
        for (PendingFile& file : files_) file.temporary.release();
        if (completed) completed();
        for (const auto& [path, folder] : folders_) remove_set(folder.set);
    }

private:
    /// Locks all folders, or none while it waits, so that two processes that need the same folders do not wait for each
    /// other. Signals are held from then on.
    void lock_folders() {
        constexpr int attempts = 2000;
        for (int i = 0; i < attempts; ++i) {
            held_.emplace();
            if (try_lock_folders()) {
                for (const auto& [path, folder] : folders_) recover_set(folder.set);
                return;
            }
            held_.reset();
            std::this_thread::sleep_for(std::chrono::milliseconds(5));
        }
        throw WriteError(files_.front().folder.string() +
                         ": another process is replacing files in this folder");
    }

    bool try_lock_folders() {
        for (auto& [path, folder] : folders_) {
            Lock lock = Lock::acquired;
            std::optional<SetFolder> set = lock_set_folder(path, MissingSet::create, lock);
            if (!set) {
                for (auto& [other_path, other] : folders_) other.set = {};
                return false;
            }
            folder.set = std::move(*set);
        }
        return true;
    }

    static void make_parts(ReplacedFolder& folder) {
        const int set = folder.set.set_file.get();
        for (const char* part : {"old", "staged"})
            if (::mkdirat(set, part, 0777) != 0) fail_write(folder.set.path() / part, "create", errno);
        folder.old_files = open_subfolder(set, "old");
        folder.new_files = open_subfolder(set, "staged");
        if (!folder.old_files || !folder.new_files) fail_write(folder.set.path(), "open", errno);
    }

    void keep_old_file(std::size_t i) {
        const PendingFile& file = files_[i];
        const ReplacedFolder& folder = folders_.at(files_[i].folder);
        const int from = folder.set.folder_file.get(), to = folder.old_files.get();
        const char* name = file.name.c_str();
        struct stat status = {};
        has_old_[i] = ::fstatat(from, name, &status, AT_SYMLINK_NOFOLLOW) == 0;
        if (!has_old_[i] && (errno != ENOENT || ::mkdirat(to, name, 0777) != 0))
            fail_write(file.target(), "write", errno);
        if (!has_old_[i]) return;
        if (file.overwrite == Overwrite::no) fail_write(file.target(), "write", EEXIST);
        if (!S_ISREG(status.st_mode)) throw WriteError(file.target().string() + ": is not a regular file");
        if (::linkat(from, name, to, name, 0) == 0) return;
        std::error_code error;  // the file system has no links
        const struct timespec times[] = {status.st_atim, status.st_mtim};
        if (!fs::copy_file(file.target(), folder.set.path() / "old" / file.name, error))
            fail_write(file.target(), "keep the file that is replaced", error.value());
        if (::utimensat(to, name, times, 0) != 0) fail_write(file.target(), "keep its time", errno);
    }

    void stage_new_file(std::size_t i) {
        const int to = folders_.at(files_[i].folder).new_files.get();
        if (::renameat(AT_FDCWD, files_[i].temporary.name(), to, files_[i].name.c_str()) != 0)
            fail_write(files_[i].target(), "write", errno);
    }

    static void sync(const Descriptor& part, const ReplacedFolder& folder) {
        if (!sync_folder(part.get())) fail_write(folder.set.folder, "sync it", errno);
    }

    static void complete(ReplacedFolder& folder) {
        sync(folder.new_files, folder);
        sync(folder.old_files, folder);
        sync(folder.set.set_file, folder);
        folder.is_complete = true;
        if (!folder.rename_part("staged", "new")) fail_write(folder.set.path(), "write", errno);
        sync(folder.set.set_file, folder);
        sync(folder.set.folder_file, folder);
    }

    void replace_file(std::size_t i) {
        const ReplacedFolder& folder = folders_.at(files_[i].folder);
        const int from = folder.new_files.get(), to = folder.set.folder_file.get();
        const char* name = files_[i].name.c_str();
        const bool renamed =
            has_old_[i] ? ::renameat(from, name, to, name) == 0 : rename_if_absent(from, name, to, name);
        if (!renamed) fail_write(files_[i].target(), "write", errno);
    }

    /// Undoes everything: the new files go back first, so that the set can be completed until the last one is back.
    /// Which files were renamed is determined by their identity, since a failed call may have done its work. Returns
    /// false if an old file cannot be restored.
    bool restore_old_files() {
        bool restored = true;
        for (std::size_t i = files_.size(); i-- > 0;) {
            if (!is_same_file(files_[i].temporary.file(), files_[i].target().c_str())) continue;
            const ReplacedFolder& folder = folders_.at(files_[i].folder);
            const int place = folder.set.folder_file.get();
            const char* name = files_[i].name.c_str();
            if (::renameat(place, name, folder.new_files.get(), name) != 0)
                restored = false;
            else if (has_old_[i])
                restored &= ::renameat(folder.old_files.get(), name, place, name) == 0;
            else
                restored &= ::unlinkat(place, name, 0) == 0 || errno == ENOENT;  // it had both names
        }
        for (const auto& [path, folder] : folders_)
            if (folder.is_complete)
                restored = restored && sync_folder(folder.set.folder_file.get()) &&
                           (folder.rename_part("new", "staged") || errno == ENOENT);
        for (const auto& [path, folder] : folders_)
            if (restored) remove_set(folder.set);
        return restored;
    }

    std::optional<HeldSignals> held_;
    std::span<PendingFile> files_;
    std::vector<bool> has_old_;  // by file: whether it replaces one
    std::map<fs::path, ReplacedFolder> folders_;
};
#endif

WriteCheck write_check = nullptr;
thread_local FileSet* collecting_set = nullptr;

}  // namespace

#ifndef _WIN32
std::optional<FileId> file_id(const fs::path& file) {
    struct stat status = {};
    if (::stat(file.c_str(), &status) != 0) return std::nullopt;
    return FileId(status.st_dev, status.st_ino);
}

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

void replace_files(std::span<PendingFile> files, void (*completed)() noexcept) {
    if (files.size() == 1)
        replace_single_file(files.front(), completed);
    else
        Replacement(files).run(completed);
}
#endif

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
