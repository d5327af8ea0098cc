#pragma once
/// \file
/// File descriptors, writing to them, errors of writing, and locks that end with the process that holds them.

#ifndef _WIN32
#include <sys/file.h>
#endif
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <system_error>
#include <utility>

#include "faqem/error.hpp"

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

/// \param action  what cannot be done, e.g. "write"
/// \param error   value of errno
/// \throws WriteError  `FILE: cannot ACTION: REASON`
[[noreturn]] inline void fail_write(const std::filesystem::path& file, const char* action, int error) {
    throw WriteError(file.string() + ": cannot " + action + ": " + std::generic_category().message(error));
}

/// Result of try_lock().
enum class Lock {
    acquired,    ///< held until the descriptor is closed
    held,        ///< by another process, or by another descriptor of this one
    unsupported  ///< the file system has no locks
};

#ifndef _WIN32
/// Writes all bytes to an opened file. Returns false and sets errno on failure; a part may be written then.
inline bool write_all(int file, std::span<const std::uint8_t> bytes) {
    while (!bytes.empty()) {
        const std::size_t chunk_size = std::min(bytes.size(), std::size_t{1} << 30);
        const ssize_t written = ::write(file, bytes.data(), chunk_size);
        if (written < 0 && errno == EINTR) continue;
        if (written == 0) errno = EIO;
        if (written <= 0) return false;
        bytes = bytes.subspan(static_cast<std::size_t>(written));
    }
    return true;
}

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
#endif

}  // namespace faqem::detail
