#pragma once
/// \file
/// Reading of whole files with a size limit, atomic writing of files, and resolution of file references.

#include <cstdint>
#include <filesystem>
#include <span>
#include <string_view>
#include <vector>

#include "faqem/asset.hpp"
#include "faqem/export.hpp"

namespace faqem::detail {

/// Reads a whole regular file. FIFOs, devices and folders are rejected without blocking.
/// \param file       path of the file
/// \param max_bytes  maximum size in bytes; a larger file is rejected before memory is allocated
/// \return the bytes of the file
/// \throws ReadError  if the file cannot be read, is not a regular file or is too large
FAQEM_EXPORT std::vector<std::uint8_t> read_file(const std::filesystem::path& file,
                                                 std::uint64_t max_bytes = std::uint64_t{1} << 34);

/// Checks whether files may be written together. Called with the paths as given; throws an exception if not.
using WriteCheck = void (*)(std::span<const std::filesystem::path> files);

/// Sets a check that write_file() and write_files() call before they write the first file, on the calling
/// thread. Initially there is none. Not thread-safe: intended for the start of a program.
FAQEM_EXPORT void set_write_check(WriteCheck check);

/// A file to be written. The bytes are borrowed.
struct FileContent {
    std::filesystem::path file;
    std::span<const std::uint8_t> bytes;
};

/// Writes a file atomically: after a failure or a crash, the path holds the complete old or the complete new
/// content. Writes a TemporaryFile in the same folder, syncs it and renames it. A new file gets the mode
/// 0666 minus the umask; a replaced file keeps its mode. Symbolic links are followed.
/// \param file       path of the file
/// \param bytes      new content, borrowed
/// \param overwrite  Overwrite::no: an existing file is an error, even if it is created during the write
/// \throws WriteError  with the path and the reason; the temporary file is removed
/// \throws whatever the write check throws; nothing is written then
FAQEM_EXPORT void write_file(const std::filesystem::path& file, std::span<const std::uint8_t> bytes,
                             Overwrite overwrite);

/// Writes several files that belong together. All temporary files are on the disk before the first one is
/// renamed, so that a full disk leaves no new file behind. The files are renamed in the given order: a file
/// that refers to the others should be the last one.
/// \param files      paths and contents, borrowed
/// \param overwrite  as in write_file()
/// \throws as write_file()
void write_files(std::span<const FileContent> files, Overwrite overwrite);

/// Syntax of a file reference inside a model file.
enum class ReferenceSyntax {
    uri,       ///< glTF: percent-encoded, slashes as separators
    file_name  ///< OBJ and MTL: literal, slashes or backslashes as separators
};

/// Resolves a file reference of an asset. The file must lie in the folder of the asset or below it after
/// symbolic links are resolved. The current directory is used only if `folder` is empty.
/// \param folder     folder of the asset; empty: the current directory
/// \param reference  path relative to `folder`
/// \param kind       syntax of the reference
/// \return the canonical path of a regular file
/// \throws ReadError   if the file does not exist or is not accessible
/// \throws InputError  if the reference is empty, is absolute, has a scheme (`http:`, `C:`), lies outside the
///                     folder or is not a regular file
FAQEM_EXPORT std::filesystem::path resolve_inside(const std::filesystem::path& folder,
                                                  std::string_view reference,
                                                  ReferenceSyntax kind = ReferenceSyntax::uri);

/// Returns the path that a file reference of an asset names, wherever it is: unlike resolve_inside(), which
/// decides what may be read, this does not examine the path, so it may name a file outside the folder or none.
/// \param folder     folder of the asset; empty: the current directory
/// \param reference  relative to `folder`, absolute, or in glTF with the scheme `file:`
/// \param kind       syntax of the reference
FAQEM_EXPORT std::filesystem::path referenced_path(const std::filesystem::path& folder,
                                                   std::string_view reference, ReferenceSyntax kind);

}  // namespace faqem::detail
