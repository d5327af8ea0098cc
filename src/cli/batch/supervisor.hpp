#pragma once
/// \file
/// Distribution of the models of a batch among worker processes.

#include <functional>
#include <vector>

#include "cli/batch/process_file.hpp"

namespace faqem::cli {

/// What a batch does after a model.
enum class NextStep {
    go_on,
    again_alone,  ///< tries the model again, in a new process, while no other uses memory
    stop          ///< begins no other model
};

/// Called by process_batch(), in this process.
struct BatchEvents {
    /// A model begins, or begins anew: it is about to be loaded.
    std::function<void(std::size_t model)> begun;
    /// A model has ended, perhaps without having begun. \param members  as of process_batch_file()
    std::function<NextStep(std::size_t model, const Json& members)> ended;
};

/// Simplifies models, each in one of several processes. A process that crashes, or is killed because its model takes too
/// long, costs only this model, which ends with exit_internal. A model that exhausts its memory is tried again while no
/// other uses memory. After a signal, models that are being simplified are cancelled, and the others end without having
/// begun.
/// \pre this process has one thread
void process_batch(const std::vector<BatchFile>& files, const BatchContext& work, const BatchEvents& events);

}  // namespace faqem::cli
