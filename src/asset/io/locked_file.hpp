#pragma once
/// \file
/// File descriptors, and locks that end with the process that holds them.

#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <utility>

namespace faqem::detail {

/// Owns a file descriptor of a file or folder and closes it on destruction.
class Descriptor {
public:
    Descriptor() = default;
    explicit Descriptor(int number) : number_(number) {}
    Descriptor(Descriptor&& other) noexcept : number_(std::exchange(other.number_, -1)) {}
    Descriptor& operator=(Descriptor&& other) noexcept {
        std::swap(number_, other.number_);
        return *this;
    }
    ~Descriptor() {
        if (number_ >= 0) ::close(number_);
    }
    int get() const { return number_; }
    explicit operator bool() const { return number_ >= 0; }

private:
    int number_ = -1;
};

/// Result of try_lock().
enum class Lock {
    acquired,    ///< held until the descriptor is closed
    held,        ///< by another process, or by another descriptor of this one
    unsupported  ///< the file system has no locks
};

/// Locks a file with flock() without waiting. The lock ends with the process, however that ends.
/// \param kind  LOCK_EX or LOCK_SH
inline Lock try_lock(int file, int kind = LOCK_EX) {
    while (::flock(file, kind | LOCK_NB) != 0) {
        if (errno == EWOULDBLOCK) return Lock::held;
        if (errno != EINTR) return Lock::unsupported;
    }
    return Lock::acquired;
}

/// Whether a path, not followed if it is a link, is the opened file. Another process may have removed or
/// replaced the file between open() and flock(); a lock on such a file protects nothing.
inline bool is_same_file(int file, const char* path) {
    struct stat opened = {}, named = {};
    return ::fstat(file, &opened) == 0 && ::lstat(path, &named) == 0 && opened.st_dev == named.st_dev &&
           opened.st_ino == named.st_ino;
}

}  // namespace faqem::detail
