#include "asset/io/replacement.hpp"

#include <fcntl.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "asset/io/held_signals.hpp"
#include "asset/io/recovery.hpp"
#include "asset/io/write_all.hpp"
#include "faqem/error.hpp"

namespace faqem::detail {
namespace {

namespace fs = std::filesystem;

void require_temporary(const PendingFile& file) {
    if (file.temporary.is_removed()) fail_write(file.target(), "write", EINTR);
}

/// Some file systems cannot sync a folder and return EINVAL.
bool sync_folder(int folder) { return ::fsync(folder) == 0 || errno == EINVAL; }

void replace_single_file(PendingFile& file, void (*completed)() noexcept) {
    const HeldSignals held;
    const ReplacementInProgress in_progress;
    require_temporary(file);
    const Descriptor folder(::open(file.folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
    if (!folder) fail_write(file.target(), "open its folder", errno);
    const char* from = file.temporary.name();
    const std::string to = file.target().string();
    const bool renamed = file.overwrite == Overwrite::yes ? ::rename(from, to.c_str()) == 0
                                                          : rename_if_absent(AT_FDCWD, from, to.c_str());
    if (!renamed) fail_write(file.target(), "write", errno);
    file.temporary.release();
    if (!sync_folder(folder.get())) fail_write(file.target(), "sync its folder", errno);
    if (completed) completed();
}

/// Copies the content, permissions and times of an opened file. Returns false and sets errno on failure.
bool copy_to(int folder, const std::string& name, int from, const struct stat& status) {
    const Descriptor to(::openat(folder, name.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0600));
    if (!to) return false;
    std::vector<std::uint8_t> buffer(std::size_t{1} << 16);
    for (off_t done = 0; done < status.st_size;) {
        const ssize_t got = ::pread(from, buffer.data(), buffer.size(), done);
        if (got < 0 && errno == EINTR) continue;
        if (got == 0) errno = EIO;
        if (got <= 0) return false;
        if (!write_all(to.get(), std::span(buffer).first(static_cast<std::size_t>(got)))) return false;
        done += got;
    }
    const struct timespec times[] = {status.st_atim, status.st_mtim};
    return ::fchmod(to.get(), status.st_mode & 07777) == 0 && ::futimens(to.get(), times) == 0 &&
           ::fsync(to.get()) == 0;
}

/// One run of replace_files() for at least two files.
class Replacement {
public:
    explicit Replacement(std::span<PendingFile> files) : files_(files) {
        for (const PendingFile& file : files_) {
            const auto known = std::find(folders_.begin(), folders_.end(), file.folder);
            folder_of_.push_back(static_cast<std::size_t>(known - folders_.begin()));
            if (known == folders_.end()) folders_.push_back(file.folder);
        }
    }

    void run(void (*completed)() noexcept) {
        lock_journals();
        try {
            for (const PendingFile& file : files_) require_temporary(file);
            keep_old_files();
            write_journals();
            for (std::size_t i = 0; i < files_.size(); ++i) rename_new_file(i);
            for (const LockedJournal& journal : journals_)
                if (!sync_folder(journal.folder_file.get())) fail_write(journal.folder, "sync it", errno);
            for (const LockedJournal& journal : journals_) clear_journal(journal);
        } catch (const WriteError& error) {
            if (restore_old_files()) throw;
            throw WriteError(std::string(error.what()) +
                             "; the files of the set cannot be restored either: the next faqem command that "
                             "writes to their folder does it");
        }
        for (PendingFile& file : files_) file.temporary.release();
        if (completed) completed();
        remove_old_files();
    }

private:
    int folder_file(std::size_t i) const { return journals_[folder_of_[i]].folder_file.get(); }

    /// Locks the journals of all folders, or of none while it waits, so that two processes that need the same
    /// folders do not wait for each other. Signals are held from then on.
    void lock_journals() {
        constexpr int attempts = 2000;
        for (int i = 0; i < attempts; ++i) {
            held_.emplace();
            in_progress_.emplace();
            if (try_lock_journals()) {
                for (LockedJournal& journal : journals_) is_clean_ &= recover_journal(journal);
                return;
            }
            in_progress_.reset();
            held_.reset();
            std::this_thread::sleep_for(std::chrono::milliseconds(5));
        }
        throw WriteError(folders_.front().string() + ": another process is replacing files in this folder");
    }

    bool try_lock_journals() {
        for (const fs::path& folder : folders_) {
            Lock lock = Lock::acquired;
            std::optional<LockedJournal> journal = open_journal(folder, MissingJournal::create, lock);
            if (!journal) {
                journals_.clear();
                return false;
            }
            journals_.push_back(std::move(*journal));
        }
        return true;
    }

    /// Fills entries_.
    void keep_old_files() {
        for (std::size_t i = 0; i < files_.size(); ++i) {
            const PendingFile& file = files_[i];
            JournalEntry& entry = entries_.emplace_back();
            entry.id = file.temporary.id();
            entry.name = file.name.string();
            entry.new_content = file.content;
            const Descriptor old(::openat(folder_file(i), entry.name.c_str(),
                                          O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC));
            if (!old && errno == ENOENT) continue;
            if (!old) fail_write(file.target(), "open the file that is replaced", errno);
            if (file.overwrite == Overwrite::no) fail_write(file.target(), "write", EEXIST);
            struct stat status = {};
            if (::fstat(old.get(), &status) != 0) fail_write(file.target(), "read", errno);
            if (!S_ISREG(status.st_mode))
                throw WriteError(file.target().string() + ": is not a regular file");
            entry.old_content = stamp_of(old.get(), static_cast<std::uint64_t>(status.st_size));
            if (!entry.old_content) fail_write(file.target(), "read the file that is replaced", EIO);
            const std::string backup = entry.backup_name();
            const int folder = folder_file(i);
            if (::linkat(folder, entry.name.c_str(), folder, backup.c_str(), 0) == 0) continue;
            if (!copy_to(folder, backup, old.get(), status))
                fail_write(file.target(), "keep the file that is replaced", errno);
        }
    }

    void write_journals() {
        for (std::size_t f = 0; f < folders_.size(); ++f) {
            std::vector<JournalEntry> entries;
            for (std::size_t i = 0; i < files_.size(); ++i)
                if (folder_of_[i] == f) entries.push_back(entries_[i]);
            const std::string text = journal_text(entries);
            const LockedJournal& journal = journals_[f];
            const std::span bytes(reinterpret_cast<const std::uint8_t*>(text.data()), text.size());
            if (!write_all(journal.file.get(), bytes)) fail_write(journal.path(), "write", errno);
            if (::fsync(journal.file.get()) != 0) fail_write(journal.path(), "write to the disk", errno);
        }
        for (const LockedJournal& journal : journals_)
            if (!sync_folder(journal.folder_file.get())) fail_write(journal.folder, "sync it", errno);
    }

    void rename_new_file(std::size_t i) {
        const std::string from = entries_[i].temporary_name(), &to = entries_[i].name;
        const int folder = folder_file(i);
        const bool renamed = entries_[i].old_content
                                 ? ::renameat(folder, from.c_str(), folder, to.c_str()) == 0
                                 : rename_if_absent(folder, from.c_str(), to.c_str());
        if (!renamed) fail_write(files_[i].target(), "write", errno);
    }

    /// Undoes everything. Which files were renamed is determined by their identity, since a failed call may
    /// have done its work. Returns false if an old file cannot be restored: its journal remains then.
    bool restore_old_files() {
        bool restored = true;
        for (std::size_t i = entries_.size(); i-- > 0;) {
            const std::string target = files_[i].target().string(), backup = entries_[i].backup_name();
            if (!is_same_file(files_[i].temporary.file(), target.c_str())) continue;
            const int folder = folder_file(i);
            restored &= entries_[i].old_content
                            ? ::renameat(folder, backup.c_str(), folder, entries_[i].name.c_str()) == 0
                            : ::unlinkat(folder, entries_[i].name.c_str(), 0) == 0;
        }
        if (!restored) return false;
        for (const LockedJournal& journal : journals_) restored &= sync_folder(journal.folder_file.get());
        try {
            for (const LockedJournal& journal : journals_) clear_journal(journal);
        } catch (const WriteError&) {
            return false;
        }
        remove_old_files();
        return true;
    }

    /// An empty journal remains if an old file does, so that the next run removes both.
    void remove_old_files() {
        bool removed = is_clean_;
        for (std::size_t i = 0; i < entries_.size(); ++i) {
            if (!entries_[i].old_content) continue;
            const std::string backup = entries_[i].backup_name();
            removed &= ::unlinkat(folder_file(i), backup.c_str(), 0) == 0 || errno == ENOENT;
        }
        if (!removed) return;
        for (const LockedJournal& journal : journals_) remove_journal(journal);
    }

    std::optional<HeldSignals> held_;
    std::optional<ReplacementInProgress> in_progress_;
    std::span<PendingFile> files_;
    std::vector<fs::path> folders_;
    std::vector<std::size_t> folder_of_;   // by file, index of its folder
    std::vector<LockedJournal> journals_;  // by folder
    std::vector<JournalEntry> entries_;    // by file
    bool is_clean_ = true;  // no backups of earlier runs remain in the folders
};

}  // namespace

void replace_files(std::span<PendingFile> files, void (*completed)() noexcept) {
    if (files.size() == 1) return replace_single_file(files.front(), completed);
    if (!files.empty()) return Replacement(files).run(completed);
    const HeldSignals held;
    if (completed) completed();
}

}  // namespace faqem::detail
