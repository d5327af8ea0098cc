#pragma once
/// \file
/// By what a batch tells that a model has changed, and how much there is of it.

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace faqem::cli {

/// The files that a model refers to: buffers and images of glTF, libraries and their images of OBJ. Those
/// that cannot be read are left out, and so are those of a model that is damaged: load() will say why.
std::vector<std::filesystem::path> referenced_files(const std::filesystem::path& model);

/// Size and time of the last change of files, as text. Empty if there is none.
std::string modification_stamp(const std::vector<std::filesystem::path>& files);

/// Sum of the sizes of the files that are there.
std::uint64_t total_file_size(const std::vector<std::filesystem::path>& files);

}  // namespace faqem::cli
