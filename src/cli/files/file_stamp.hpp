#pragma once
/// \file
/// A stamp that changes when a file changes.

#include <filesystem>
#include <string>
#include <vector>

namespace faqem::cli {

/// Returns the sizes and modification times of files as text. Missing files are omitted.
std::string modification_stamp(const std::vector<std::filesystem::path>& files);

}  // namespace faqem::cli
