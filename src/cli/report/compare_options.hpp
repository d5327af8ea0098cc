#pragma once
/// \file
/// The options that say how thoroughly two models are compared.

#include "faqem/compare.hpp"

namespace CLI {
class App;
}

namespace faqem::cli {

/// Adds them to a command; they are read into `options`, which has to live on.
void add_compare_options(CLI::App& command, CompareOptions& options);

}  // namespace faqem::cli
