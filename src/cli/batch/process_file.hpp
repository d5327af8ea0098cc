#pragma once
/// \file
/// Processing of one model of a batch.

#include <cstdint>
#include <functional>

#include "cli/batch/plan.hpp"
#include "cli/files/input_model.hpp"
#include "cli/process/exit_code.hpp"
#include "cli/process/json.hpp"
#include "faqem/asset.hpp"
#include "faqem/options.hpp"

namespace faqem::cli {

/// Options and state shared by all models of a batch.
struct BatchContext {
    Options options;
    std::string options_key;  ///< everything except the input files that results depend on
    Strictness strictness = Strictness::lenient;
    bool strict_target = false;
    std::uint64_t max_memory = 0;  ///< bytes, of all models at the same time
    std::uint32_t jobs = 1;        ///< processes at a time
    double end_after = 0;          ///< seconds that a model may take before its process is killed
    Overwrite overwrite = Overwrite::no;
    bool until_eof = false;  ///< the end of standard input counts as SIGTERM
};

/// Asks for memory, which replaces that of earlier calls, and waits for it. Takes and returns bytes; less is returned only
/// if no other model uses memory. Empty: all memory is granted.
using AskMemory = std::function<std::uint64_t(std::uint64_t)>;

/// Simplifies one model as `faqem simplify` does. A result with BatchFile::earlier is skipped if it is up to date, and may
/// be overwritten if nobody else has changed it. Limits the memory of the process to what is granted.
/// \return the members of the line that is printed for the model, without its names (see docs/reference.md), and
/// `record`: what a Ledger has besides. If the memory that was granted is exhausted, and there is more, the member
/// `retry`, and `overwrite` for the next attempt
Json process_batch_file(const BatchFile& file, const BatchContext& work, Overwrite overwrite,
                        const AskMemory& ask_memory);

/// Returns the line that is printed for a model. \param members  of process_batch_file()
std::string printed_line(const BatchFile& file, const Json& members);

/// Returns the members of the line of a model, without warnings.
/// \param status   `done`, `skipped`, `failed` or `cancelled`
/// \param message  the reason
Json batch_line(ExitCode code, const std::string& status, const std::string& message,
                std::uint64_t faces_in = 0, std::uint64_t faces_out = 0);

}  // namespace faqem::cli
