#pragma once
/// \file
/// Numbers as text, independent of the locale: writes them, and reads coordinates with a record of their digits.

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <string>
#include <string_view>

#include "asset/text/text_scanner.hpp"
#include "faqem/asset.hpp"

namespace faqem::detail {

/// Adds a number to the digits of a text: those from its first digit that is not zero on, and those after the point when
/// it is written without an exponent.
/// \param text  a number, possibly after blanks
inline void count_digits(std::string_view text, StoredPrecision& most) {
    std::int64_t digits = 0, decimals = 0;
    bool has_point = false;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        if (c == '.') has_point = true;
        if (c == 'e' || c == 'E') {
            std::int32_t exponent = 0;
            const std::size_t first = i + 1 + (i + 1 < text.size() && text[i + 1] == '+');
            std::from_chars(text.data() + first, text.data() + text.size(), exponent);
            decimals -= exponent;
            break;
        }
        if (c < '0' || c > '9') continue;
        digits += digits > 0 || c != '0';
        decimals += has_point;
    }
    most.type = StoredPrecision::Type::decimal;
    most.digits = std::max(most.digits, static_cast<std::uint32_t>(digits));
    most.decimals =
        std::max(most.decimals, static_cast<std::uint32_t>(std::clamp<std::int64_t>(decimals, 0, 400)));
}

/// Reads the next number as a coordinate. \throws InputError  as TextScanner::number()
inline double read_coordinate(TextScanner& in, StoredPrecision& most) {
    const std::string_view before = in.remaining();
    const auto value = in.number<double>();
    count_digits(before.substr(0, before.size() - in.remaining().size()), most);
    return value;
}

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
