#pragma once
/// \file
/// Which models a batch works on, and what their results are called.

#include <filesystem>
#include <string>
#include <vector>

namespace faqem::cli {

/// One model of a batch.
struct BatchFile {
    std::filesystem::path in, out;
    std::string name;      ///< of the input, relative to the folder, with slashes
    std::string out_name;  ///< of the result, relative to its folder, with slashes
    std::uint64_t bytes = 0;
};

/// Finds the .glb, .gltf, .obj, .ply, .stl and .off files of a folder and all folders below, by their names
/// in any case, and names the results: the same place in the other folder, with another extension. Links to
/// folders are not followed. What lies in `out_folder` is no input.
/// \param extension  of the results, with the dot
/// \return largest first, then by name
/// \throws ReadError    a folder cannot be read
/// \throws InputError   there are no models
/// \throws OptionError  both folders are one, two models would have one result (the message names them), or a
///                      result would replace an input
std::vector<BatchFile> plan_batch(const std::filesystem::path& folder,
                                  const std::filesystem::path& out_folder, const std::string& extension);

}  // namespace faqem::cli
