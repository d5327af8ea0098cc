#pragma once
/// \file
/// Numbers to text, independent of the locale.

#include <array>
#include <charconv>
#include <cmath>
#include <string>

namespace faqem::detail {

/// Appends the shortest text that reads back as the same value of its type.
template <class T>
void append_number(std::string& text, T value) {
    std::array<char, 32> digits;
    const auto result = std::to_chars(digits.data(), digits.data() + digits.size(), value);
    text.append(digits.data(), result.ptr);
}

/// Rounded to six decimals. A display value made from a linear float comes back the same after another round
/// trip, which the last bits of a float would not.
inline double round_to_six_decimals(double value) { return std::round(value * 1e6) / 1e6; }

}  // namespace faqem::detail
