#pragma once
/// \file
/// Processing of one model of a batch.

#include <cstdint>
#include <string>

#include "cli/batch/memory_semaphore.hpp"
#include "cli/batch/plan.hpp"
#include "cli/batch/record.hpp"
#include "cli/files/input_model.hpp"
#include "cli/process/exit_code.hpp"
#include "faqem/asset.hpp"
#include "faqem/options.hpp"

namespace faqem::cli {

/// Options and state shared by all models of a batch.
struct BatchContext {
    Options options;
    std::string options_key;  ///< everything except the input files that results depend on
    Strictness strictness = Strictness::lenient;
    bool strict_target = false;
    bool resume = false;
    Overwrite overwrite = Overwrite::no;
    BatchRecord& record;
    MemorySemaphore& memory;
};

/// Simplifies one model as `faqem simplify` does. With `resume`, up-to-date results are skipped, and results
/// that the record lists and that were not changed since may be overwritten. Waits for memory. A model that
/// fails because others use the memory is processed again when no other model is. Thread-safe.
/// \param line  receives the JSON object that is printed for the model, with the keys documented in
/// docs/cli.md, as a line of text
/// \return the exit code that `faqem simplify` would return; exit_ok if skipped
ExitCode process_batch_file(const BatchFile& file, const BatchContext& work, std::string& line);

}  // namespace faqem::cli
