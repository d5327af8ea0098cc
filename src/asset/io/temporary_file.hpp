#pragma once
/// \file
/// Temporary files that are locked while they are written, and removal of those that dead processes left. They are renamed
/// without interruption: signals that would end the process are held meanwhile.

#include <signal.h>
#include <sys/types.h>

#include <atomic>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <random>
#include <string>
#include <string_view>

#include "asset/io/descriptor.hpp"
#include "faqem/export.hpp"

namespace faqem::detail {

/// Name of a new temporary file, with a random number.
inline std::string temporary_name() {
    std::random_device random;
    char name[40];
    std::snprintf(name, sizeof name, ".faqem-%08x%08x%08x.tmp", random(), random(), random());
    return name;
}

#ifdef _WIN32
/// A handle of a file that is deleted when it is closed, however the process ends, unless it was given its name.
using TemporaryFile = std::shared_ptr<void>;
#else

/// A new, locked file `.faqem-N.tmp`, where N is a random number of 24 hexadecimal digits. It is removed on
/// destruction unless release() was called. On file systems without locks it is not locked.
class FAQEM_EXPORT TemporaryFile {
public:
    /// \param target  file that the temporary file will replace: it is created in the same folder
    /// \param mode    permissions, reduced by the umask
    /// \param shown   name of the target in messages
    /// \throws WriteError  the file cannot be created
    TemporaryFile(const std::filesystem::path& target, mode_t mode, const std::filesystem::path& shown);
    TemporaryFile(const std::filesystem::path& target, mode_t mode) : TemporaryFile(target, mode, target) {}
    TemporaryFile(TemporaryFile&& other) noexcept;
    TemporaryFile& operator=(TemporaryFile&&) = delete;
    ~TemporaryFile();

    /// Absolute path.
    const char* name() const { return name_.get(); }
    /// Open for writing. Closing it ends the lock.
    int file() const { return file_.get(); }
    /// Whether remove_temporary_files() has removed the file.
    bool is_removed() const { return slot_ && slot_->load() != name_.get(); }
    /// Keeps the file: called after it was renamed to its final name.
    void release() { unregister(); }

private:
    void unregister();

    std::unique_ptr<char[]> name_;
    std::atomic<char*>* slot_ = nullptr;
    Descriptor file_;
};

/// Whether a file name is that of a TemporaryFile.
bool is_temporary_name(std::string_view name);

/// Renames a file unless the new name exists. Returns false and sets errno on failure; then the file may have both names.
/// The folders are descriptors, or AT_FDCWD.
bool rename_if_absent(int from_folder, const char* from, int to_folder, const char* to);

/// States that the calling thread is replacing files, and holds the signals that end a process by default and that users,
/// shells and timers send (HUP, INT, QUIT, TERM, ALRM, USR1, USR2 ...) for it: they are delivered at destruction. In a
/// process with several threads, another thread may receive such a signal; its handler should call
/// remove_temporary_files() and end the process only if that returns true.
class HeldSignals {
public:
    /// \throws WriteError  remove_temporary_files() has returned true: the process is about to end
    HeldSignals();
    ~HeldSignals();
    HeldSignals(const HeldSignals&) = delete;
    HeldSignals& operator=(const HeldSignals&) = delete;

private:
    sigset_t before_;
};
#endif

/// Removes the temporary files of a folder whose lock is free: the processes that wrote them are dead. Files
/// that cannot be locked or removed remain.
/// Complexity: lists the folder once.
FAQEM_EXPORT void remove_leftovers(const std::filesystem::path& folder) noexcept;

/// Removes the temporary files of all writes in progress. Async-signal-safe: intended for the handler of
/// SIGINT and SIGTERM, which ends the process afterwards.
/// \return false if a thread is replacing files: nothing was removed, and the process must not end yet. After
/// true, writes in progress and later ones fail.
[[nodiscard]] FAQEM_EXPORT bool remove_temporary_files() noexcept;

}  // namespace faqem::detail
