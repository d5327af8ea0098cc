#pragma once
/// \file
/// Distribution of the models of a batch among worker processes.

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "cli/batch/process_file.hpp"

namespace faqem::cli {

/// The processes of a batch.
struct WorkerOptions {
    std::uint32_t jobs = 1;  ///< processes at a time
    double end_after = 0;    ///< seconds that a model may take before its process is killed
    Overwrite overwrite = Overwrite::no;
};

/// Simplifies models, each in one of several processes. A process that crashes, or is killed because its model takes too
/// long, costs only this model. A model that exhausts its memory, or whose process was killed by the system, is tried
/// again while no other uses memory. After a signal, models that are being simplified are cancelled, and the others are
/// not begun.
/// \pre this process has one thread
/// \param print  receives the line of each model when it is finished
/// \return exit_ok if each model is done or up to date, exit_cancelled after a signal, otherwise exit_batch_incomplete
ExitCode process_batch(const std::vector<BatchFile>& files, const BatchContext& work,
                       const WorkerOptions& workers, const std::function<void(const std::string&)>& print);

}  // namespace faqem::cli
