#pragma once
/// \file
/// A batch over the models of a directory, or of a shard of a list, with its records.

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "cli/batch/ledger.hpp"
#include "cli/batch/supervisor.hpp"
#include "cli/options/simplify_options.hpp"

namespace faqem::cli {

/// What a batch is asked to do.
struct RunArguments {
    std::filesystem::path list;  ///< empty: the models are those of a directory
    std::filesystem::path out_folder;
    std::string extension;  ///< of outputs that the list does not name, with the dot
    Shard shard = {};
    std::string list_hash = {};  ///< SHA-256 of the list, which models_of_shard() sets
    bool reads_records = false;  ///< what earlier attempts have done is not done again
    bool replaces_run = false;   ///< with a list: the directory may have the results of another run
};

/// The models of a shard, by decreasing size of the input, then by id. Reads the list once.
/// \param given  options of the command line, which those of a model take precedence over
/// \throws ReadError, InputError  as read_list(); two models of the shard have the same id or output, an output is outside
/// the output directory, or an input is inside it
/// \throws OptionError  an option of a model is unknown, or its value wrong; the message names the model
std::vector<BatchFile> models_of_shard(RunArguments& arguments, const GivenOptions& given);

/// Simplifies models, and records what becomes of each.
/// \param files  of plan_batch() or models_of_shard(); those of a shard that have an end already are left out
/// \param print  receives a line for each model that is not left out
/// \return without a list exit_ok, exit_batch_incomplete, or exit_cancelled if a model was not done because of a signal;
/// with one exit_ok if each model has an end, otherwise exit_try_again, after a signal or because results could not be
/// written
/// \throws OptionError, WriteError  as Ledger and join_run()
ExitCode run_batch(const std::vector<BatchFile>& files, const RunArguments& arguments,
                   const BatchContext& work, const std::function<void(const std::string&)>& print);

}  // namespace faqem::cli
