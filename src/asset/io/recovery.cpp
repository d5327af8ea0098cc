#include "asset/io/recovery.hpp"

#include <fcntl.h>

#include <algorithm>
#include <chrono>
#include <string>
#include <system_error>
#include <thread>

#include "asset/io/held_signals.hpp"
#include "asset/io/temporary_file.hpp"
#include "faqem/error.hpp"

namespace faqem::detail {
namespace {

namespace fs = std::filesystem;

/// Whether a regular file of a folder has the recorded content. Links are not followed.
bool has_content(int folder, const std::string& name, const ContentStamp& content) {
    const Descriptor file(
        ::openat(folder, name.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC));
    struct stat status = {};
    if (!file || ::fstat(file.get(), &status) != 0 || !S_ISREG(status.st_mode)) return false;
    const auto size = static_cast<std::uint64_t>(status.st_size);
    return size == content.size && stamp_of(file.get(), size) == content;
}

bool is_absent(int folder, const std::string& name) {
    struct stat status = {};
    return ::fstatat(folder, name.c_str(), &status, AT_SYMLINK_NOFOLLOW) != 0 && errno == ENOENT;
}

/// What a folder holds of one file of a set.
struct EntryState {
    bool is_new = false, is_old = false;            ///< the file under its final name
    bool has_temporary = false, has_backup = false;  ///< with the recorded content

    bool can_finish() const { return is_new || (is_old && has_temporary); }
    bool can_restore(const JournalEntry& entry) const {
        return is_old || (is_new && (has_backup || !entry.old_content));
    }
};

EntryState state_of(int folder, const JournalEntry& entry) {
    EntryState state;
    state.is_new = has_content(folder, entry.name, entry.new_content);
    state.is_old = entry.old_content ? has_content(folder, entry.name, *entry.old_content)
                                     : is_absent(folder, entry.name);
    state.has_temporary = has_content(folder, entry.temporary_name(), entry.new_content);
    state.has_backup = entry.old_content && has_content(folder, entry.backup_name(), *entry.old_content);
    return state;
}

class Recovery {
public:
    Recovery(const LockedJournal& journal, const std::vector<JournalEntry>& entries)
        : journal_(journal), folder_(journal.folder_file.get()), entries_(entries) {
        for (const JournalEntry& entry : entries_) states_.push_back(state_of(folder_, entry));
    }

    void run() {
        std::size_t finishable = 0, restorable = 0;
        for (std::size_t i = 0; i < entries_.size(); ++i) {
            finishable += states_[i].can_finish();
            restorable += states_[i].can_restore(entries_[i]);
        }
        if (finishable == entries_.size())
            finish();
        else if (restorable == entries_.size())
            restore();
        else
            fail_changed();
        if (::fsync(folder_) != 0 && errno != EINVAL) fail(entries_.back().name, errno);
    }

private:
    void finish() {
        for (std::size_t i = 0; i < entries_.size(); ++i) {
            if (states_[i].is_new) continue;
            const std::string from = entries_[i].temporary_name(), &to = entries_[i].name;
            const bool renamed = entries_[i].old_content
                                     ? ::renameat(folder_, from.c_str(), folder_, to.c_str()) == 0
                                     : rename_if_absent(folder_, from.c_str(), to.c_str());
            if (!renamed) fail(to, errno);
        }
    }

    void restore() {
        for (std::size_t i = 0; i < entries_.size(); ++i) {
            if (states_[i].is_old) continue;
            const std::string from = entries_[i].backup_name(), &to = entries_[i].name;
            const bool restored = entries_[i].old_content
                                      ? ::renameat(folder_, from.c_str(), folder_, to.c_str()) == 0
                                      : ::unlinkat(folder_, to.c_str(), 0) == 0;
            if (!restored) fail(to, errno);
        }
    }

    [[noreturn]] void fail(const std::string& name, int error) const {
        throw WriteError((journal_.folder / name).string() + ": cannot complete the set of files that " +
                         journal_.path() + " describes: " + std::generic_category().message(error));
    }

    [[noreturn]] void fail_changed() const {
        std::size_t i = 0;
        while (i + 1 < entries_.size() && (states_[i].is_new || states_[i].is_old)) ++i;
        throw WriteError((journal_.folder / entries_[i].name).string() +
                         ": belongs to a set of files that an interrupted run replaced only in part, and was "
                         "changed since; check the files, then delete " +
                         journal_.path());
    }

    const LockedJournal& journal_;
    int folder_;
    const std::vector<JournalEntry>& entries_;
    std::vector<EntryState> states_;
};

/// Removes the temporary files and backups of a folder whose journal is locked and describes no set. Returns
/// false if a backup remains.
bool remove_set_leftovers(const LockedJournal& journal) {
    bool removed = true;
    std::error_code error;
    fs::directory_iterator entry(journal.folder, error);
    for (; !error && entry != fs::directory_iterator(); entry.increment(error)) {
        const std::string name = entry->path().filename().string();
        if (is_backup_name(name)) removed &= ::unlinkat(journal.folder_file.get(), name.c_str(), 0) == 0;
    }
    remove_leftovers(journal.folder);
    return removed && !error;
}

fs::path folder_of(const fs::path& file) { return file.has_parent_path() ? file.parent_path() : "."; }

}  // namespace

bool recover_journal(LockedJournal& journal) {
    int error = 0;
    const auto entries = read_journal(journal.file.get(), error);
    if (error != 0)
        throw WriteError(journal.path() + ": cannot read: " + std::generic_category().message(error));
    if (entries) Recovery(journal, *entries).run();
    clear_journal(journal);
    return remove_set_leftovers(journal);
}

void recover_folder(const fs::path& folder) {
    // A process that reads the journal holds its lock for a moment.
    constexpr int attempts = 50;
    for (int i = 0; i < attempts; ++i) {
        const HeldSignals held;
        const ReplacementInProgress in_progress;
        Lock lock = Lock::acquired;
        std::error_code error;
        if (!fs::is_directory(folder, error)) return;
        if (auto journal = open_journal(folder, MissingJournal::ignore, lock)) {
            if (recover_journal(*journal)) remove_journal(*journal);
            return;
        }
        if (lock != Lock::held) return;
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
}

void check_completely_replaced(const fs::path& file) {
    std::error_code error;
    const fs::path found = fs::canonical(file, error), real = error ? file : found;
    const fs::path folder = folder_of(real);
    const Descriptor journal(
        ::open((folder / journal_name).c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC));
    if (!journal) return;
    while (::flock(journal.get(), LOCK_SH | LOCK_NB) != 0) {
        if (errno == EWOULDBLOCK) return;  // the set is being replaced by another process
        if (errno != EINTR) break;
    }
    int journal_error = 0;
    const auto entries = read_journal(journal.get(), journal_error);
    if (journal_error != 0)
        throw ReadError((folder / journal_name).string(), "",
                        "cannot read: " + std::generic_category().message(journal_error));
    if (!entries) return;
    const std::string name = real.filename().string();
    if (std::none_of(entries->begin(), entries->end(), [&](const auto& entry) { return entry.name == name; }))
        return;
    throw ReadError(file.string(), "",
                    "belongs to a set of files that an interrupted run replaced only in part; any faqem "
                    "command that writes to the folder " +
                        folder.string() +
                        " completes or restores the set, for example the interrupted one again");
}

}  // namespace faqem::detail
