#pragma once
/// \file
/// A shard of a list: its models, and what the records say about them.

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "cli/batch/ledger.hpp"
#include "cli/batch/supervisor.hpp"
#include "cli/options/simplify_options.hpp"

namespace faqem::cli {

/// What `faqem batch --list` is asked to do.
struct ShardArguments {
    std::filesystem::path list, out_folder;
    std::string extension;  ///< of outputs that the list does not name, with the dot
    Shard shard = {};
    bool redoes = false;        ///< also models that are done
    bool replaces_run = false;  ///< the directory may have the results of another run
};

/// The models of a shard, by decreasing size of the input, then by id.
/// \param given  options of the command line, which those of a model take precedence over
/// \throws ReadError, InputError  as read_list(); two models of the shard have the same id or output, an output is outside
/// the output directory, or an input is inside it
/// \throws OptionError  an option of a model is unknown, or its value wrong; the message names the model
std::vector<BatchFile> models_of_shard(const ShardArguments& arguments, const GivenOptions& given);

/// Simplifies the models of a shard that have no end yet, and records what becomes of each.
/// \param files  models_of_shard()
/// \param print  receives a line for each model that is not done
/// \return exit_ok if each model has an end, exit_try_again if some have none after a signal or because files could not be
/// written
/// \throws OptionError, WriteError  as Ledger
ExitCode run_shard(const std::vector<BatchFile>& files, const ShardArguments& arguments,
                   const BatchContext& work, const WorkerOptions& workers,
                   const std::function<void(const std::string&)>& print);

}  // namespace faqem::cli
