#pragma once
/// \file
/// One pass over a text in memory: words, numbers, lines. Numbers do not depend on the locale.

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <system_error>
#include <type_traits>

#include "faqem/error.hpp"

namespace faqem::detail {

/// What a backslash at the end of a line means.
enum class Continuation { no, yes };

/// Lines end with LF, CR or CRLF; a byte order mark at the start is skipped. Views returned point into the
/// text.
class TextScanner {
public:
    /// \param file   for messages: `file: line 17: ...`
    /// \param lines  lines before the text
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
    /// Number of the current line, from 1.
    std::uint64_t line() const { return line_; }
    bool at_end() const { return at_ == end_; }
    /// Everything not read yet.
    std::string_view remaining() const { return {at_, static_cast<std::size_t>(end_ - at_)}; }

    [[noreturn]] void fail(const std::string& what) const {
        throw InputError(file_, "line " + std::to_string(line_), what);
    }

    /// Skips blanks and a comment (from `#` on); true when nothing else is left on the line.
    bool at_line_end() {
        skip_blanks();
        if (at_ != end_ && *at_ == '#')
            while (at_ != end_ && !is_newline(*at_)) ++at_;
        return at_ == end_ || is_newline(*at_);
    }

    /// Goes to the start of the next line, whatever is left on this one.
    void next_line() {
        while (at_ != end_ && !is_newline(*at_))
            if (!skip_continuation()) ++at_;
        if (at_ != end_) skip_newline();
    }

    /// Goes to the start of the next line.
    /// \throws InputError  when something but a comment is left on this one
    void finish_line() {
        if (!at_line_end()) fail("unexpected " + quoted(word()));
        if (at_ != end_) skip_newline();
    }

    /// Goes to the next line that holds anything but a comment; false at the end of the text.
    bool skip_to_content() {
        while (at_line_end()) {
            if (at_ == end_) return false;
            skip_newline();
        }
        return true;
    }

    /// The next word of this line, empty when there is none. `#` has no meaning here.
    std::string_view word() {
        skip_blanks();
        const char* first = at_;
        while (!ends_word(at_)) ++at_;
        return {first, static_cast<std::size_t>(at_ - first)};
    }

    /// Takes the next word if it is `expected`.
    bool accept_word(std::string_view expected) {
        skip_blanks();
        if (remaining().substr(0, expected.size()) != expected || !ends_word(at_ + expected.size()))
            return false;
        at_ += expected.size();
        return true;
    }

    /// The rest of the line without the blanks around it: a name, which may hold blanks and `#`.
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

    /// The next word as a number of type T (an integer or floating-point type), which it must be to its last
    /// character. Infinities and NaN are numbers, also as old C libraries print them (`1.#QNAN`).
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

    /// The next character if it is `c`, without skipping blanks.
    bool accept(char c) {
        if (at_ == end_ || *at_ != c) return false;
        ++at_;
        return true;
    }

    /// An integer here, followed by anything; no blanks are skipped. False when there is none.
    bool accept_integer(std::int64_t& value) {
        const char* first = at_ != end_ && *at_ == '+' && at_ + 1 != end_ && at_[1] != '-' ? at_ + 1 : at_;
        const auto [last, error] = std::from_chars(first, end_, value);
        if (error != std::errc{}) return false;
        at_ = last;
        return true;
    }

    /// True when a blank, the end of the line or the end of the text comes next.
    bool at_word_end() const { return ends_word(at_); }

    /// A word in quotes for a message, shortened and without control characters.
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
        if (text.empty()) fail("a number is missing");
        if constexpr (std::is_floating_point_v<T>) {
            const std::size_t hash = text.find(".#");
            if (hash != std::string_view::npos && hash + 2 < text.size())
                return text[hash + 2] == 'I' && text.substr(hash + 3, 2) == "NF"
                           ? std::numeric_limits<T>::infinity()
                           : std::numeric_limits<T>::quiet_NaN();
            // Too large or too small for T: infinity or zero, as the nearest value would be. On a copy with a
            // zero at its end, which the long double overload of libstdc++ 12 needs: it reads on past `last`.
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
        fail(quoted(text) + " is not a number" + (std::is_integral_v<T> ? " this place can hold" : ""));
    }

    const char* at_;
    const char* end_;
    std::uint64_t line_;
    std::string file_;
    bool continues_;
};

}  // namespace faqem::detail
