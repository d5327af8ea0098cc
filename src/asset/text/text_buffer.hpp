#pragma once
/// \file
/// A growing buffer for writing large text files, and locale-independent conversion of numbers to text.

#include <array>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <new>
#include <string>
#include <string_view>

namespace faqem::detail {

/// A text buffer that is appended to. Numbers are formatted in place, and realloc() can often grow the block
/// without copying: with std::string, copies took half of the time of writing a large OBJ file.
/// All put functions throw std::bad_alloc if memory is exhausted.
class TextBuffer {
public:
    void put(char c) {
        ensure_space(1);
        data_.get()[size_++] = c;
    }

    void put(std::string_view text) {
        ensure_space(text.size());
        if (!text.empty()) std::memcpy(data_.get() + size_, text.data(), text.size());
        size_ += text.size();
    }

    /// Appends the shortest decimal text that reads back as the same value of type T, independent of the
    /// locale.
    template <class T>
    void put_number(T value) {
        ensure_space(longest_number);
        char* at = data_.get() + size_;
        size_ = static_cast<std::size_t>(std::to_chars(at, at + longest_number, value).ptr - data_.get());
    }

    std::string_view view() const { return {data_.get(), size_}; }
    const char* data() const { return data_.get(); }
    std::size_t size() const { return size_; }

private:
    static constexpr std::size_t longest_number = 32;

    void ensure_space(std::size_t more) {
        if (more <= capacity_ - size_) return;
        const std::size_t capacity = capacity_ + capacity_ / 2 + more + 4096;
        auto* grown = static_cast<char*>(std::realloc(data_.get(), capacity));
        if (!grown) throw std::bad_alloc();
        (void)data_.release();
        data_.reset(grown);
        capacity_ = capacity;
    }

    struct Free {
        void operator()(char* memory) const { std::free(memory); }
    };
    std::unique_ptr<char, Free> data_;
    std::size_t size_ = 0, capacity_ = 0;
};

/// Appends the shortest decimal text that reads back as the same value of type T.
template <class T>
void append_number(std::string& text, T value) {
    std::array<char, 32> digits;
    const auto result = std::to_chars(digits.data(), digits.data() + digits.size(), value);
    text.append(digits.data(), result.ptr);
}

/// Rounds to six decimals. An sRGB value computed from a linear float is then stable under repeated
/// conversion; the last bits of a float would not be.
inline double round_to_six_decimals(double value) { return std::round(value * 1e6) / 1e6; }

}  // namespace faqem::detail
