#pragma once
/// \file
/// Locale-independent conversion of numbers to text.

#include <array>
#include <charconv>
#include <cmath>
#include <string>
#include <string_view>

namespace faqem::detail {

/// Appends the shortest decimal text that reads back as the same value of type T.
template <class T>
void append_number(std::string& text, T value) {
    std::array<char, 32> digits;
    const auto result = std::to_chars(digits.data(), digits.data() + digits.size(), value);
    text.append(digits.data(), result.ptr);
}

/// Appends a line: the key, then each number after a blank.
template <class Numbers>
void append_line(std::string& text, std::string_view key, const Numbers& numbers) {
    text += key;
    for (const auto number : numbers) {
        text += ' ';
        append_number(text, number);
    }
    text += '\n';
}

/// Rounds to six decimals. An sRGB value computed from a linear float is then stable under repeated
/// conversion; the last bits of a float would not be.
inline double round_to_six_decimals(double value) { return std::round(value * 1e6) / 1e6; }

}  // namespace faqem::detail
