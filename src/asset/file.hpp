#pragma once
/// \file
/// Files as whole byte arrays: read with a size cap, written completely or not at all.

#include <cstdint>
#include <filesystem>
#include <span>
#include <string_view>
#include <vector>

#include "faqem/asset.hpp"
#include "faqem/export.hpp"

namespace faqem::detail {

/// Reads a regular file. FIFOs, devices and folders are refused without waiting for them.
/// \param max_bytes  a larger file is an error before anything is allocated
/// \throws ReadError  naming the file and the reason
FAQEM_EXPORT std::vector<std::uint8_t> read_file(const std::filesystem::path& file,
                                                 std::uint64_t max_bytes = std::uint64_t{1} << 34);

/// One file to be written; the bytes belong to the caller.
struct FileContent {
    std::filesystem::path file;
    std::span<const std::uint8_t> bytes;
};

/// Writes a file so that, whatever happens, the old or the new content is there, complete: a temporary file
/// in the same folder, synced, then renamed. A new file gets 0666 without the umask, a replaced one keeps its
/// mode; a symbolic link is followed.
/// \param overwrite  no: a file that exists is an error, also when it appears while we write
/// \throws WriteError  with path and reason; no temporary file is left behind
FAQEM_EXPORT void write_file(const std::filesystem::path& file, std::span<const std::uint8_t> bytes,
                             Overwrite overwrite);

/// Writes several files that belong together: the first is put in place after all of them are on the disk, so
/// that a full disk leaves nothing new behind. They appear in the order given: put the one that refers to the
/// others last.
/// \throws WriteError  as write_file()
void write_files(std::span<const FileContent> files, Overwrite overwrite);

/// Removes the temporary files of writes under way. Async-signal-safe: meant for the handler of SIGINT and
/// SIGTERM, which ends the process afterwards (the interrupted write fails if it is let go on).
FAQEM_EXPORT void remove_temporary_files() noexcept;

/// How a reference in a file is written.
enum class ReferenceSyntax {
    uri,       ///< glTF: percent-encoded, separated by slashes
    file_name  ///< OBJ, MTL: literal, separated by slashes or backslashes
};

/// Finds a file referred to from an asset and makes sure that it lies in the asset's folder or below,
/// symbolic links followed. The current directory plays no part.
/// \param folder  folder of the asset; empty: the current directory
/// \param reference  path relative to it
/// \return the canonical path of a regular file
/// \throws ReadError  no such file, or it cannot be looked at
/// \throws InputError  empty, absolute, with a scheme (`http:`, `C:`), leading outside, or not a regular file
FAQEM_EXPORT std::filesystem::path resolve_inside(const std::filesystem::path& folder,
                                                  std::string_view reference,
                                                  ReferenceSyntax kind = ReferenceSyntax::uri);

}  // namespace faqem::detail
