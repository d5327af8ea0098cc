#include "asset/io/set_folder.hpp"

#include <fcntl.h>

#include <chrono>
#include <string>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

#include "asset/io/file.hpp"
#include "asset/io/temporary_file.hpp"
#include "faqem/error.hpp"

namespace faqem::detail {
namespace {

namespace fs = std::filesystem;

/// Removes everything but the lock.
void clear_set(const SetFolder& set) noexcept try {
    for (const char* part : {"new", "staged", "old"}) {
        std::error_code error;
        if (const Descriptor opened = open_subfolder(set.set_file.get(), part)) {
            for (const std::string& name : file_names(set.path() / part, error))
                if (::unlinkat(opened.get(), name.c_str(), 0) != 0)
                    ::unlinkat(opened.get(), name.c_str(), AT_REMOVEDIR);
        }
        ::unlinkat(set.set_file.get(), part, AT_REMOVEDIR);
    }
} catch (const std::exception&) {  // what remains is harmless
}

std::pair<time_t, long> changed(const struct stat& file) {
    return {file.st_mtim.tv_sec, file.st_mtim.tv_nsec};
}

bool is_in(int folder, const char* name, struct stat& status) {
    return ::fstatat(folder, name, &status, AT_SYMLINK_NOFOLLOW) == 0;
}

/// Whether the place of a new file of a set still has the old file, or none if there was none, or the new one.
bool is_unchanged(const SetFolder& set, int new_files, int old_files, const char* name) {
    struct stat next = {}, now = {}, old = {};
    if (!is_in(new_files, name, next) || !S_ISREG(next.st_mode)) return false;
    if (!is_in(set.folder_file.get(), name, now)) return errno == ENOENT;
    if (now.st_ino == next.st_ino && now.st_dev == next.st_dev) return true;
    return is_in(old_files, name, old) && S_ISREG(old.st_mode) && S_ISREG(now.st_mode) &&
           now.st_size == old.st_size && changed(now) == changed(old) && changed(now) <= changed(next);
}

/// Moves the new files of a set that has not been completed to their places.
void complete_set(const SetFolder& set, int new_files) {
    const Descriptor old_files = open_subfolder(set.set_file.get(), "old");
    const int folder = set.folder_file.get();
    std::error_code error;
    const std::vector<std::string> names = file_names(set.path() / "new", error);
    if (error) fail_write(set.path(), "read", error.value());
    for (const std::string& name : names)
        if (!is_unchanged(set, new_files, old_files.get(), name.c_str()))
            throw WriteError((set.folder / name).string() +
                             ": belongs to a set of files that an interrupted run replaced only in part, and "
                             "was changed since; check the files, then delete " +
                             set.path().string());
    for (const std::string& name : names) {
        struct stat now = {};
        const bool renamed = is_in(folder, name.c_str(), now)
                                 ? ::renameat(new_files, name.c_str(), folder, name.c_str()) == 0
                                 : rename_if_absent(new_files, name.c_str(), folder, name.c_str());
        if (!renamed) fail_write(set.folder / name, "complete its set of files", errno);
    }
    if (!sync_folder(folder)) fail_write(set.folder, "sync it", errno);
}

}  // namespace

Descriptor open_subfolder(int folder, const char* name) {
    return Descriptor(::openat(folder, name, O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC));
}

bool sync_folder(int folder) { return ::fsync(folder) == 0 || errno == EINVAL; }

std::optional<SetFolder> lock_set_folder(const fs::path& folder, MissingSet missing, Lock& lock) {
    SetFolder set;
    set.folder = folder;
    lock = Lock::acquired;
    set.folder_file = Descriptor(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
    if (!set.folder_file) fail_write(folder, "open the folder", errno);
    for (;;) {
        bool is_new = false;
        if (missing == MissingSet::create) {
            is_new = ::mkdirat(set.folder_file.get(), set_folder_name, 0777) == 0;
            if (!is_new && errno != EEXIST) fail_write(set.path(), "create the folder", errno);
        }
        set.set_file = open_subfolder(set.folder_file.get(), set_folder_name);
        if (!set.set_file && errno == ENOENT && missing == MissingSet::ignore) return std::nullopt;
        if (!set.set_file && errno == ENOENT) continue;  // removed by another process in the meantime
        if (!set.set_file && (errno == ENOTDIR || errno == ELOOP))
            throw WriteError(set.path().string() + ": is not a folder; remove it");
        if (!set.set_file) fail_write(set.path(), "open", errno);
        constexpr int flags = O_RDWR | O_CREAT | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC;
        set.lock_file = Descriptor(::openat(set.set_file.get(), "lock", flags, 0666));
        if (!set.lock_file && errno == ENOENT) continue;
        if (!set.lock_file) fail_write(set.path(), "lock", errno);
        lock = try_lock(set.lock_file.get());
        if (lock == Lock::held) return std::nullopt;
        if (lock == Lock::unsupported && !is_new)
            throw WriteError(set.path().string() +
                             ": cannot be locked; remove it if no other run writes to this folder");
        if (is_same_file(set.lock_file.get(), (set.path() / "lock").c_str())) return set;
    }
}

void recover_set(const SetFolder& set) {
    const Descriptor new_files = open_subfolder(set.set_file.get(), "new");
    if (!new_files && errno != ENOENT) fail_write(set.path() / "new", "open", errno);
    if (new_files) complete_set(set, new_files.get());
    clear_set(set);
}

void remove_set(const SetFolder& set) noexcept {
    clear_set(set);
    ::unlinkat(set.set_file.get(), "lock", 0);
    ::unlinkat(set.folder_file.get(), set_folder_name, AT_REMOVEDIR);
}

void recover_folder(const fs::path& folder) {
    // A process that reads a file of the set holds the lock for a moment.
    constexpr int attempts = 50;
    for (int i = 0; i < attempts; ++i) {
        const HeldSignals held;
        Lock lock = Lock::acquired;
        std::error_code error;
        if (!fs::is_directory(folder, error)) return;
        if (const auto set = lock_set_folder(folder, MissingSet::ignore, lock)) {
            recover_set(*set);
            remove_set(*set);
            return remove_leftovers(folder);
        }
        if (lock != Lock::held) return;
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
}

void check_completely_replaced(const fs::path& file) {
    std::error_code error;
    const fs::path found = fs::canonical(file, error), real = error ? file : found;
    const fs::path folder = parent_of(real), set = folder / set_folder_name;
    const Descriptor lock(::open((set / "lock").c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC));
    if (lock && try_lock(lock.get(), LOCK_SH) == Lock::held)
        return;  // the set is being replaced by another process
    if (file_names(set / "new", error).empty()) return;
    if (fs::symlink_status(set / "old" / real.filename(), error).type() == fs::file_type::not_found) return;
    throw ReadError(file.string(), "",
                    "belongs to a set of files that an interrupted run replaced only in part; any faqem "
                    "command that writes to the folder " +
                        folder.string() + " completes the set, for example the interrupted one again");
}

}  // namespace faqem::detail
