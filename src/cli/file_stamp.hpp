#pragma once
/// \file
/// The total size of files, and a stamp that changes when one of them changes.

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace faqem::cli {

/// Returns the sizes and modification times of files as text. Missing files are omitted.
std::string modification_stamp(const std::vector<std::filesystem::path>& files);

/// Returns the total size, in bytes, of the files that exist.
std::uint64_t total_file_size(const std::vector<std::filesystem::path>& files);

}  // namespace faqem::cli
