#pragma once
/// \file
/// Single-pass scanner for words, numbers and lines of a text in memory, and numbers as text. Independent of the locale.

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <system_error>
#include <type_traits>

#include "faqem/asset.hpp"
#include "faqem/error.hpp"

namespace faqem::detail {

/// Whether a backslash at the end of a line joins it with the next line.
enum class Continuation { no, yes };

/// Scans a text. Lines end with LF, CR or CRLF; a UTF-8 byte order mark at the start is skipped. The text is
/// borrowed, and the returned views point into it.
class TextScanner {
public:
    /// \param text          borrowed
    /// \param file          path for error messages: `file: line 17: ...`
    /// \param continuation  whether backslashes join lines
    /// \param lines         number of lines before the text, for error messages
    TextScanner(std::span<const std::uint8_t> text, std::string file, Continuation continuation,
                std::uint64_t lines = 0)
        : at_(reinterpret_cast<const char*>(text.data())),
          end_(at_ + text.size()),
          line_(lines + 1),
          file_(std::move(file)),
          continues_(continuation == Continuation::yes) {
        if (remaining().substr(0, 3) == "\xEF\xBB\xBF") at_ += 3;
    }

    const std::string& file() const { return file_; }
    /// Number of the current line, starting at 1.
    std::uint64_t line() const { return line_; }
    bool at_end() const { return at_ == end_; }
    /// The text that has not been read yet.
    std::string_view remaining() const { return {at_, static_cast<std::size_t>(end_ - at_)}; }

    /// \throws InputError  always, with the file and the current line
    [[noreturn]] void fail(const std::string& what) const {
        throw InputError(file_, "line " + std::to_string(line_), what);
    }

    /// Skips blanks and a comment that starts with `#`. Returns whether the end of the line is reached.
    bool at_line_end() {
        skip_blanks();
        if (at_ != end_ && *at_ == '#')
            while (at_ != end_ && !is_newline(*at_)) ++at_;
        return at_ == end_ || is_newline(*at_);
    }

    /// Advances to the start of the next line and ignores the rest of the current one.
    void next_line() {
        while (at_ != end_ && !is_newline(*at_))
            if (!skip_continuation()) ++at_;
        if (at_ != end_) skip_newline();
    }

    /// Advances to the start of the next line.
    /// \throws InputError  if the rest of the current line is neither blank nor a comment
    void finish_line() {
        if (!at_line_end()) fail("unexpected " + quoted(word()));
        if (at_ != end_) skip_newline();
    }

    /// Advances to the next line that is neither blank nor a comment. Returns false at the end of the text.
    bool skip_to_content() {
        while (at_line_end()) {
            if (at_ == end_) return false;
            skip_newline();
        }
        return true;
    }

    /// Reads the next word of this line; empty if there is none. `#` does not start a comment here.
    std::string_view word() {
        skip_blanks();
        const char* first = at_;
        while (!ends_word(at_)) ++at_;
        return {first, static_cast<std::size_t>(at_ - first)};
    }

    /// Reads the next word if it equals `expected`. Returns whether it did.
    bool accept_word(std::string_view expected) {
        skip_blanks();
        if (remaining().substr(0, expected.size()) != expected || !ends_word(at_ + expected.size()))
            return false;
        at_ += expected.size();
        return true;
    }

    /// Reads the rest of the line and trims blanks at both ends. Used for names, which may contain blanks and
    /// `#`.
    std::string rest_of_line() {
        std::string text;
        skip_blanks();
        while (at_ != end_ && !is_newline(*at_)) {
            if (skip_continuation())
                text.push_back(' ');
            else
                text.push_back(*at_++);
        }
        while (!text.empty() && is_blank(text.back())) text.pop_back();
        return text;
    }

    /// Reads the next word as a number. The whole word must be a number. Infinities and NaN are accepted,
    /// also in the spelling of old C libraries (`1.#QNAN`).
    /// \tparam T  an integer or floating-point type
    /// \throws InputError  if there is no word or it is not a number of type T
    template <class T>
    T number() {
        skip_blanks();
        const char* first = at_;
        if (first != end_ && *first == '+' && first + 1 != end_ && first[1] != '-') ++first;
        T value{};
        const auto [last, error] = std::from_chars(first, end_, value);
        if (error == std::errc{} && ends_word(last)) {
            at_ = last;
            return value;
        }
        return unusual_number<T>(first);
    }

    /// Reads the next character if it is `c`. Blanks are not skipped.
    bool accept(char c) {
        if (at_ == end_ || *at_ != c) return false;
        ++at_;
        return true;
    }

    /// Reads an integer at the current position; it may be followed by any character. Blanks are not skipped.
    /// Returns false if there is no integer.
    bool accept_integer(std::int64_t& value) {
        const char* first = at_ != end_ && *at_ == '+' && at_ + 1 != end_ && at_[1] != '-' ? at_ + 1 : at_;
        const auto [last, error] = std::from_chars(first, end_, value);
        if (error != std::errc{}) return false;
        at_ = last;
        return true;
    }

    /// Whether the next character is a blank or the end of the line or text.
    bool at_word_end() const { return ends_word(at_); }

    /// Quotes a word for an error message: at most 40 characters, control characters replaced.
    static std::string quoted(std::string_view word) {
        std::string text = "'";
        for (const char c : word.substr(0, 40))
            text += static_cast<unsigned char>(c) < 32 || c == 127 ? '?' : c;
        text += word.size() > 40 ? "...'" : "'";
        return text;
    }

private:
    static bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\v' || c == '\f'; }
    static bool is_newline(char c) { return c == '\n' || c == '\r'; }

    bool ends_word(const char* p) const {
        return p == end_ || is_blank(*p) || is_newline(*p) || (*p == '\\' && is_continuation(p));
    }
    bool is_continuation(const char* p) const { return continues_ && p + 1 != end_ && is_newline(p[1]); }

    void skip_newline() {
        const bool pair = *at_ == '\r' && at_ + 1 != end_ && at_[1] == '\n';
        at_ += pair ? 2 : 1;
        ++line_;
    }

    bool skip_continuation() {
        if (*at_ != '\\' || !is_continuation(at_)) return false;
        ++at_;
        skip_newline();
        return true;
    }

    void skip_blanks() {
        while (at_ != end_ && (is_blank(*at_) || *at_ == '\\')) {
            if (*at_ != '\\')
                ++at_;
            else if (!skip_continuation())
                return;
        }
    }

    template <class T>
    T unusual_number(const char* first) {
        const std::string_view text = word();
        if (text.empty()) fail("expected a number");
        if constexpr (std::is_floating_point_v<T>) {
            const std::size_t hash = text.find(".#");
            if (hash != std::string_view::npos && hash + 2 < text.size())
                return text[hash + 2] == 'I' && text.substr(hash + 3, 2) == "NF"
                           ? std::numeric_limits<T>::infinity()
                           : std::numeric_limits<T>::quiet_NaN();
            // Values out of the range of T become infinity or zero, which is the nearest value. The text is
            // copied because from_chars() for long double in libstdc++ 12 reads past `last` and needs the
            // terminating zero of std::string.
            const std::string copy(first, text.data() + text.size());
            long double wide = 0;
            const auto [last, error] = std::from_chars(copy.data(), copy.data() + copy.size(), wide);
            if (error == std::errc{} && last == copy.data() + copy.size()) {
                const bool fits = std::abs(wide) <= static_cast<long double>(std::numeric_limits<T>::max());
                return fits ? static_cast<T>(wide)
                            : std::copysign(std::numeric_limits<T>::infinity(),
                                            static_cast<T>(wide < 0 ? -1 : 1));
            }
        }
        fail(quoted(text) + " is not a number" +
             (std::is_integral_v<T> ? " of the expected integer type" : ""));
    }

    const char* at_;
    const char* end_;
    std::uint64_t line_;
    std::string file_;
    bool continues_;
};

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
