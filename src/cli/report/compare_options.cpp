#include "cli/report/compare_options.hpp"

#include <CLI/CLI.hpp>

namespace faqem::cli {

void add_compare_options(CLI::App& command, CompareOptions& options) {
    command.add_option("--samples", options.samples, "Samples on each model (default 200000)")
        ->check(CLI::Range(std::uint64_t{1}, std::uint64_t{1} << 32));
    command.add_option("--seed", options.seed, "Another seed, other samples (default 1)");
    command
        .add_option("--tolerance", options.tolerance,
                    "Gap allowed between a largest distance and its bound, as a share of it (default 0.01)")
        ->check(CLI::Range(0.0, 1e9));
    command.add_option("--threads", options.threads, "Threads at most; the result does not depend on it")
        ->check(CLI::Range(0, 1024));
}

}  // namespace faqem::cli
