#pragma once
/// \file
/// The models of a batch and the names of their results.

#include <filesystem>
#include <string>
#include <vector>

namespace faqem::cli {

/// One model of a batch.
struct BatchFile {
    std::filesystem::path in, out;
    std::string name;         ///< path of the input relative to the input directory, with slashes
    std::string out_name;     ///< path of the result relative to the output directory, with slashes
    std::uint64_t bytes = 0;  ///< size of the input file; 0 if it cannot be read
    std::string problem;      ///< why the input cannot be read; empty: it can, as far as is known
};

/// Finds the files of a directory and its subdirectories that have the extension of a readable format (ignoring
/// case), and assigns the paths of the results: the same relative path in the output directory, with another
/// extension. Links to directories are not followed. A link to a file that does not exist is a model with a problem.
/// The output directory is not searched.
/// \param folder      input directory
/// \param out_folder  output directory; need not exist
/// \param extension   of the results, with the dot
/// \param others      receives the number of files that are no models
/// \return the models, by decreasing file size, then by name
/// \throws ReadError    a directory cannot be read
/// \throws InputError   there are no models
/// \throws OptionError  both directories are the same, or two models have the same result (the message names
/// them)
std::vector<BatchFile> plan_batch(const std::filesystem::path& folder,
                                  const std::filesystem::path& out_folder, const std::string& extension,
                                  std::size_t& others);

}  // namespace faqem::cli
