#include "asset/io/temporary_file.hpp"

#include <fcntl.h>

#include <array>
#include <cstring>
#include <system_error>
#include <utility>

#include "faqem/error.hpp"

namespace faqem::detail {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view temporary_prefix = ".faqem-", temporary_extension = ".tmp";
constexpr std::size_t temporary_digits = 24;

/// Names of the temporary files of this process. The code that exchanges a slot with null owns the name: the
/// writer frees it; the signal handler leaks it, because it must not free memory. Blocks are never freed.
struct NameSlots {
    std::array<std::atomic<char*>, 64> names = {};
    std::atomic<NameSlots*> next = nullptr;
};
static_assert(std::atomic<char*>::is_always_lock_free, "used in a signal handler");

NameSlots first_slots;

std::atomic<char*>& register_temporary(char* name) {
    for (NameSlots* slots = &first_slots;; slots = slots->next) {
        for (std::atomic<char*>& slot : slots->names) {
            char* empty = nullptr;
            if (slot.compare_exchange_strong(empty, name)) return slot;
        }
        if (slots->next) continue;
        auto added = std::make_unique<NameSlots>();
        NameSlots* none = nullptr;
        if (slots->next.compare_exchange_strong(none, added.get())) (void)added.release();
    }
}

/// Removes a temporary file if its lock is free.
void remove_if_unlocked(const fs::path& file) {
    const Descriptor opened(::open(file.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC));
    struct stat status = {};
    if (!opened || ::fstat(opened.get(), &status) != 0 || !S_ISREG(status.st_mode)) return;
    if (try_lock(opened.get()) == Lock::acquired && is_same_file(opened.get(), file.c_str()))
        ::unlink(file.c_str());
}

constexpr int held_signals[] = {SIGHUP,  SIGINT,  SIGQUIT,   SIGTERM, SIGALRM,
                                SIGUSR1, SIGUSR2, SIGVTALRM, SIGPROF, SIGXCPU};

/// Number of threads that are replacing files; `ending` after begin_exit().
std::atomic<int> replacing = 0;
constexpr int ending = -1;
static_assert(std::atomic<int>::is_always_lock_free, "used in a signal handler");

/// Returns whether the process may end: no thread is replacing files. From then on none can begin to.
/// Async-signal-safe.
bool begin_exit() noexcept {
    int none = 0;
    return replacing.compare_exchange_strong(none, ending) || none == ending;
}

}  // namespace

TemporaryFile::TemporaryFile(const fs::path& target, mode_t mode, const fs::path& shown) {
    do {
        const std::string path = fs::absolute(target.parent_path() / temporary_name()).string();
        name_ = std::make_unique<char[]>(path.size() + 1);
        std::memcpy(name_.get(), path.c_str(), path.size() + 1);
        // The name is registered before the file is created; removing a file that does not exist is harmless.
        slot_ = &register_temporary(name_.get());
        file_ = Descriptor(::open(name_.get(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, mode));
        if (!file_) {
            const int error = errno;
            unregister();
            throw WriteError(shown.string() + ": cannot create a temporary file in its folder: " +
                             std::generic_category().message(error));
        }
        // Another run may take the file for a leftover before it is locked, and remove it.
        while (::flock(file_.get(), LOCK_EX) != 0 && errno == EINTR) {
        }
        if (is_same_file(file_.get(), name_.get())) return;
        if (is_removed()) return;  // by remove_temporary_files()
        unregister();
    } while (true);
}

TemporaryFile::TemporaryFile(TemporaryFile&& other) noexcept
    : name_(std::move(other.name_)),
      slot_(std::exchange(other.slot_, nullptr)),
      file_(std::move(other.file_)) {}

TemporaryFile::~TemporaryFile() {
    if (!slot_) return;
    ::unlink(name_.get());
    unregister();
}

void TemporaryFile::unregister() {
    if (!slot_) return;
    char* own = name_.get();
    // If the slot has another value, the signal handler is reading the name.
    if (!slot_->compare_exchange_strong(own, nullptr)) (void)name_.release();
    slot_ = nullptr;
}

HeldSignals::HeldSignals() {
    sigset_t held;
    sigemptyset(&held);
    for (const int number : held_signals) sigaddset(&held, number);
    pthread_sigmask(SIG_BLOCK, &held, &before_);
    int count = replacing;
    do {
        if (count != ending) continue;
        pthread_sigmask(SIG_SETMASK, &before_, nullptr);
        throw WriteError("cannot write: the process is ending");
    } while (!replacing.compare_exchange_weak(count, count + 1));
}

HeldSignals::~HeldSignals() {
    --replacing;
    pthread_sigmask(SIG_SETMASK, &before_, nullptr);
}

bool is_temporary_name(std::string_view name) {
    if (!name.starts_with(temporary_prefix) || !name.ends_with(temporary_extension)) return false;
    if (name.size() != temporary_prefix.size() + temporary_digits + temporary_extension.size()) return false;
    return name.substr(temporary_prefix.size(), temporary_digits).find_first_not_of("0123456789abcdef") ==
           std::string_view::npos;
}

void remove_leftovers(const fs::path& folder) noexcept try {
    for (const fs::directory_entry& entry : fs::directory_iterator(folder))
        if (is_temporary_name(entry.path().filename().string())) remove_if_unlocked(entry.path());
} catch (const std::exception&) {  // the folder cannot be listed: its leftovers are harmless
}

bool rename_if_absent(int from_folder, const char* from, int to_folder, const char* to) {
#ifdef RENAME_NOREPLACE
    if (::renameat2(from_folder, from, to_folder, to, RENAME_NOREPLACE) == 0) return true;
    if (errno != EINVAL && errno != ENOSYS) return false;
#endif
    // Fallback: linkat() fails if the target exists; after success the other name is no longer needed.
    return ::linkat(from_folder, from, to_folder, to, 0) == 0 && ::unlinkat(from_folder, from, 0) == 0;
}

bool remove_temporary_files() noexcept {
    if (!begin_exit()) return false;
    const int error = errno;
    for (NameSlots* slots = &first_slots; slots; slots = slots->next)
        for (std::atomic<char*>& slot : slots->names)
            if (const char* name = slot.exchange(nullptr)) ::unlink(name);
    errno = error;
    return true;
}

}  // namespace faqem::detail
