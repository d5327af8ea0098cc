#pragma once
/// \file
/// Validators and options that several commands share.

#include <CLI/CLI.hpp>
#include <string>

#include "faqem/compare.hpp"

namespace faqem::cli {

/// Returns a validator for numbers above 0. CLI::PositiveNumber is not used because its message prints the
/// largest double with all digits.
inline CLI::Validator positive_number() {
    return CLI::Validator(
        [](std::string& text) {
            double value = 0;
            const bool read = CLI::detail::lexical_cast(text, value);
            return read && value > 0 ? std::string() : "'" + text + "' is not a number above 0";
        },
        "POSITIVE");
}

/// Adds the options of comparing two models (`faqem compare` and `faqem report`) to a command.
/// \param options  receives the values; must outlive the command
void add_compare_options(CLI::App& command, CompareOptions& options);

}  // namespace faqem::cli
