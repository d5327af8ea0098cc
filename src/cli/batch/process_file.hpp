#pragma once
/// \file
/// One model of a batch.

#include <string>

#include "cli/batch/memory_semaphore.hpp"
#include "cli/batch/plan.hpp"
#include "cli/batch/record.hpp"
#include "cli/exit_code.hpp"
#include "cli/json.hpp"
#include "cli/simplify_model.hpp"
#include "faqem/asset.hpp"

namespace faqem::cli {

/// What all models of a batch share.
struct BatchContext {
    Options options;
    std::string options_key;  ///< what results depend on besides the models
    Strictness strictness = Strictness::lenient;
    bool strict_target = false;
    bool resume = false;
    Overwrite overwrite = Overwrite::no;
    BatchRecord& record;
    MemorySemaphore& memory;
};

/// Does what simplify does with one model, unless that is done already and resume is set. Results that the
/// record knows, and that nobody changed, may be replaced then. Waits for memory. Throws nothing.
/// \param line  receives what is to be told about it
/// \return what simplify's exit code would be; exit_ok where it was done already
ExitCode process_batch_file(const BatchFile& file, const BatchContext& work, Json& line);

}  // namespace faqem::cli
