#include "cli/options/common_options.hpp"

namespace faqem::cli {

void add_compare_options(CLI::App& command, CompareOptions& options) {
    command.add_option("--samples", options.samples, "Samples on each model (default 200000)")
        ->check(CLI::Range(std::uint64_t{1}, std::uint64_t{1} << 32));
    command.add_option("--seed", options.seed, "Seed of the samples (default 1)");
    command
        .add_option("--tolerance", options.tolerance,
                    "Relative difference allowed between a maximum distance and its bound (default 0.01)")
        ->check(CLI::Range(0.0, 1e9));
    command
        .add_option("--threads", options.threads,
                    "Maximum number of threads; 0: all (default). The result does not depend on it")
        ->check(CLI::Range(0, 1024));
}

}  // namespace faqem::cli
