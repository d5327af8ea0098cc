#pragma once
/// \file
/// The files that belong to a model, their total size, and a stamp that changes when one of them changes.

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace faqem::cli {

/// Which of the files that a model refers to.
enum class References {
    /// Those that load() may read: buffers and images of glTF, material libraries and their textures of OBJ,
    /// in the folder of the model or below it.
    readable,
    /// All, read or not and in any folder: every `uri` of a glTF document, also in extensions and extras;
    /// libraries, their texture statements of any kind and other files of OBJ; `TextureFile` comments of PLY.
    /// Where a statement can be understood in several ways, the files of all of them.
    all
};

/// Returns the files that a model refers to and that exist, each path once, without the model. As many as
/// possible of a damaged model; load() reports the reason. The format is detected as by load(). Of the files,
/// only material libraries in the folder of the model or below it are read.
std::vector<std::filesystem::path> referenced_files(const std::filesystem::path& model, References which);

/// Returns the sizes and modification times of files as text. Missing files are omitted.
std::string modification_stamp(const std::vector<std::filesystem::path>& files);

/// Returns the total size, in bytes, of the files that exist.
std::uint64_t total_file_size(const std::vector<std::filesystem::path>& files);

}  // namespace faqem::cli
