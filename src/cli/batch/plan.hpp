#pragma once
/// \file
/// The models of a batch, the names of their results, and what is known of these.

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "cli/process/json.hpp"
#include "faqem/options.hpp"

namespace faqem::cli {

/// Sizes and modification times of files as text, which changes when one of them changes. Missing files are omitted.
std::string modification_stamp(const std::vector<std::filesystem::path>& files);

/// What the records of a batch over a directory say about a result.
struct EarlierResult {
    std::string inputs;   ///< modification_stamp() of the model and the files it refers to
    std::string options;  ///< BatchFile::options_id
    std::string written;  ///< modification_stamp() of the result; empty: none was written
    std::uint64_t faces_in = 0, faces_out = 0;
    /// The stamp of the file that was there when an attempt began the result, if no attempt has ended since.
    std::optional<std::string> replaced = {};
};

/// One model of a batch.
struct BatchFile {
    std::filesystem::path in, out = {};
    std::string name;  ///< path of the input relative to the input directory, with slashes; of a list: the id
    std::string out_name = {};  ///< path of the result relative to the output directory, with slashes
    std::uint64_t bytes = 0;    ///< size of the input file; 0 if it cannot be read
    std::string problem = {};   ///< why the input cannot be read; empty: it can, as far as is known
    std::string hash = {};      ///< model_hash() that the input must have; empty: any
    Json listed_options = {};   ///< of this model in a list, with the names of the command; null: none
    std::uint32_t crashes = 0;  ///< attempts that ended so: the next one gets all memory
    bool has_begun = false;     ///< in this run
    std::optional<Options> options = {};  ///< instead of those of the batch
    std::string options_id = {};          ///< of everything except the input files that the result depends on
    std::optional<EarlierResult> earlier = {};  ///< that may be skipped or replaced
};

/// Finds the files of a directory and its subdirectories that have the extension of a readable format, ignoring case.
/// Links to directories are not followed. A link to a file that does not exist is a model with a problem.
/// \param others    receives the number of files that are no models
/// \param excluded  a directory that is not searched; empty: none
/// \return the models without results, by name
/// \throws ReadError   a directory cannot be read
/// \throws InputError  there are no models
std::vector<BatchFile> find_models(const std::filesystem::path& folder, std::size_t& others,
                                   const std::filesystem::path& excluded = {});

/// Finds the models of a directory, as find_models(), and assigns the paths of the results: the same relative path in the
/// output directory, with another extension. The output directory is not searched.
/// \param folder      input directory
/// \param out_folder  output directory; need not exist
/// \param extension   of the results, with the dot
/// \param others      as of find_models()
/// \return the models, by decreasing file size, then by name
/// \throws ReadError, InputError  as find_models()
/// \throws OptionError  both directories are the same, or two models have the same result (the message names
/// them)
std::vector<BatchFile> plan_batch(const std::filesystem::path& folder,
                                  const std::filesystem::path& out_folder, const std::string& extension,
                                  std::size_t& others);

}  // namespace faqem::cli
