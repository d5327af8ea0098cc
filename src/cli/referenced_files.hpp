#pragma once
/// \file
/// The files that belong to a model, their total size, and a stamp that changes when one of them changes.

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace faqem::cli {

/// Returns the files that a model refers to: buffers and images of glTF, material libraries and their images
/// of OBJ.
/// Files that cannot be found and references of a damaged model are omitted; load() reports the reason.
std::vector<std::filesystem::path> referenced_files(const std::filesystem::path& model);

/// Returns the sizes and modification times of files as text. Missing files are omitted.
std::string modification_stamp(const std::vector<std::filesystem::path>& files);

/// Returns the total size, in bytes, of the files that exist.
std::uint64_t total_file_size(const std::vector<std::filesystem::path>& files);

}  // namespace faqem::cli
