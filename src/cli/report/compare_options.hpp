#pragma once
/// \file
/// The options of comparing two models, shared by `faqem compare` and `faqem report`.

#include "faqem/compare.hpp"

namespace CLI {
class App;
}

namespace faqem::cli {

/// Adds the options to a command. \param options  receives the values; must outlive the command
void add_compare_options(CLI::App& command, CompareOptions& options);

}  // namespace faqem::cli
