#pragma once
/// \file
/// The page about a batch over a list.

#include <string>

#include "cli/batch/run_summary.hpp"

namespace faqem::cli {

/// Returns an HTML page: the numbers of models by their end, what is missing, and the worst models.
std::string batch_page(const RunSummary& summary);

}  // namespace faqem::cli
