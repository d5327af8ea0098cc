#pragma once
/// \file
/// Reading of whole files with a size limit, resolution of file references, and names of files.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "faqem/detail/base/lower_case.hpp"
#include "faqem/export.hpp"

namespace faqem::detail {

/// Reads a whole regular file. FIFOs, devices and folders are rejected without blocking.
/// \param file       path of the file
/// \param max_bytes  maximum size in bytes; a larger file is rejected before memory is allocated
/// \return the bytes of the file
/// \throws ReadError  if the file cannot be read, is not a regular file, is too large, or belongs to a set of
///                    files that an interrupted run replaced only in part (check_completely_replaced())
FAQEM_EXPORT std::vector<std::uint8_t> read_file(const std::filesystem::path& file,
                                                 std::uint64_t max_bytes = std::uint64_t{1} << 34);

/// Identifies an existing file by its volume and its number there; links are followed. Nothing if there is no such file.
using FileId = std::pair<std::uint64_t, std::uint64_t>;
FAQEM_EXPORT std::optional<FileId> file_id(const std::filesystem::path& file);

/// The names in a folder, in the order of the file system. \param folder  empty: the current directory
std::vector<std::string> file_names(const std::filesystem::path& folder, std::error_code& error);

/// Syntax of a file reference inside a model file.
enum class ReferenceSyntax {
    uri,       ///< glTF: percent-encoded, slashes as separators
    file_name  ///< OBJ and MTL: literal, slashes or backslashes as separators
};

/// Decodes percent escapes. A percent sign that is not followed by two hexadecimal digits is kept.
std::string percent_decoded(std::string_view text);

/// Replaces bytes other than ASCII letters, digits and those of `plain` by percent escapes.
FAQEM_EXPORT std::string percent_encoded(std::string_view text, std::string_view plain);

/// Resolves a file reference of an asset. The file must lie in the folder of the asset or below it after
/// symbolic links are resolved. The current directory is used only if `folder` is empty.
/// \param folder     folder of the asset; empty: the current directory
/// \param reference  path relative to `folder`
/// \param kind       syntax of the reference
/// \return the canonical path of a regular file
/// \throws ReadError   if the file does not exist or is not accessible
/// \throws InputError  if the reference is empty, is absolute, has a scheme (`http:`, `C:`), lies outside the
///                     folder or is not a regular file
std::filesystem::path resolve_inside(const std::filesystem::path& folder, std::string_view reference,
                                     ReferenceSyntax kind = ReferenceSyntax::uri);

/// Returns the path that a file reference of an asset names, wherever it is: unlike resolve_inside(), which
/// decides what may be read, this does not examine the path, so it may name a file outside the folder or none.
/// \param folder     folder of the asset; empty: the current directory
/// \param reference  relative to `folder`, absolute, or in glTF with the scheme `file:`
/// \param kind       syntax of the reference
std::filesystem::path referenced_path(const std::filesystem::path& folder, std::string_view reference,
                                      ReferenceSyntax kind);

/// The folder of a file; "." if its path has none.
inline std::filesystem::path parent_of(const std::filesystem::path& file) {
    return file.has_parent_path() ? file.parent_path() : ".";
}

/// Returns the extension of a file name with its dot, in lower case (ASCII).
inline std::string lower_case_extension(const std::filesystem::path& file) {
    return lower_case(file.extension().string());
}

/// File name of the buffer of STEM.gltf: STEM.bin.
inline std::string buffer_file_name(const std::string& stem) { return stem + ".bin"; }

/// File name of the material library of STEM.obj: STEM.mtl.
inline std::string library_file_name(const std::string& stem) { return stem + ".mtl"; }

/// File name of an image beside a model: STEM_0.png ...
/// \param number     of the image, from 0
/// \param extension  with its dot
inline std::string image_file_name(const std::string& stem, std::size_t number,
                                   const std::string& extension) {
    return stem + "_" + std::to_string(number) + extension;
}

}  // namespace faqem::detail
