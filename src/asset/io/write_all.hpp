#pragma once
/// \file
/// Writing of bytes to an opened file, and errors of writing.

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <system_error>

#include "faqem/error.hpp"

namespace faqem::detail {

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

/// \param action  what cannot be done, e.g. "write"
/// \param error   value of errno
/// \throws WriteError  `FILE: cannot ACTION: REASON`
[[noreturn]] inline void fail_write(const std::filesystem::path& file, const char* action, int error) {
    throw WriteError(file.string() + ": cannot " + action + ": " +
                     std::generic_category().message(error));
}

}  // namespace faqem::detail
