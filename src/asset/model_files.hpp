#pragma once
/// \file
/// The files that belong to a model: those that it refers to, and those that are written beside it.

#include <cstdint>
#include <filesystem>
#include <system_error>
#include <vector>

#include "asset/io/file_finder.hpp"
#include "faqem/export.hpp"

namespace faqem::detail {

/// Returns the files that a model refers to and that exist, each path once, without the model. As many as
/// possible of a damaged model; load() reports the reason. The format is detected as by load(). Of the files,
/// only material libraries in the folder of the model or below it are read.
/// \param model  a model, or a material library (.mtl)
/// \param which  References::readable: buffers and images of glTF, libraries and their textures of OBJ, `TextureFile`
///               comments of PLY, also those that name a path of another computer.
///               References::all: also every `uri` of a glTF document; texture statements of any kind and other files
///               of OBJ; files outside the folder of the model
FAQEM_EXPORT std::vector<std::filesystem::path> referenced_files(const std::filesystem::path& model,
                                                                 References which);

/// Returns the total size, in bytes, of the files that exist.
inline std::uint64_t total_file_size(const std::vector<std::filesystem::path>& files) {
    std::uint64_t sum = 0;
    for (const std::filesystem::path& file : files) {
        std::error_code error;
        const std::uintmax_t size = std::filesystem::file_size(file, error);
        if (!error) sum += size;
    }
    return sum;
}

/// Finds the files that exist and that save() may replace when it writes the models: buffers, libraries, and
/// images of any number and extension. On a file system that ignores case, files whose names differ in case are
/// found too.
/// Complexity: lists each folder once.
/// \throws WriteError  a folder of a model with such files exists and cannot be listed
FAQEM_EXPORT std::vector<std::filesystem::path> existing_side_files(
    const std::vector<std::filesystem::path>& models);

}  // namespace faqem::detail
