#pragma once
/// \file
/// A check of option values.

#include <CLI/CLI.hpp>
#include <string>

namespace faqem::cli {

/// A number above 0. CLI::PositiveNumber says so with the largest double, digit by digit.
inline CLI::Validator positive_number() {
    return CLI::Validator(
        [](std::string& text) {
            double value = 0;
            const bool read = CLI::detail::lexical_cast(text, value);
            return read && value > 0 ? std::string() : "'" + text + "' is no number above 0";
        },
        "POSITIVE");
}

}  // namespace faqem::cli
