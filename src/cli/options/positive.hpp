#pragma once
/// \file
/// Validation of option values.

#include <CLI/CLI.hpp>
#include <string>

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

}  // namespace faqem::cli
