/// \file
/// What faqem uses of C++20 and the C++ library of emscripten 3.1.6 (libc++ 13) does not have. The toolchain of
/// WebAssembly (cmake/web.cmake) includes it in each file. A newer library needs only the numbers at the end.

// Not in the checks of CMake, which are older C++.
#if __cplusplus > 201703L && !defined(FAQEM_LIBCXX13)
#define FAQEM_LIBCXX13

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cstdio>
#include <cstdlib>
#include <string>

namespace std {  // NOLINT(cert-dcl58-cpp): the names are those of the standard

#if _LIBCPP_VERSION < 14000
template <class To, class From>
constexpr To bit_cast(const From& from) noexcept {
    return __builtin_bit_cast(To, from);
}

inline to_chars_result to_chars(char* first, char* last, double value) {
    std::array<char, 32> text{};
    int size = 0;
    for (int digits = 1; digits <= 17; ++digits) {
        size = std::snprintf(text.data(), text.size(), "%.*g", digits, value);
        if (std::strtod(text.data(), nullptr) == value) break;
    }
    if (last - first < size) return {last, errc::value_too_large};
    return {std::copy_n(text.data(), size, first), errc{}};
}
#endif

#if _LIBCPP_VERSION < 200000
/// The C library of emscripten has no locales, so strtod() reads a point.
inline from_chars_result from_chars(const char* first, const char* last, double& value) {
    const string text(first, last);
    const size_t digit = text.starts_with('-') ? 1 : 0;
    // These strtod() reads, and from_chars() does not: spaces, a plus sign, hexadecimal numbers.
    if (digit == text.size() || std::string_view(" \t\n\v\f\r+-").find(text[digit]) != string::npos ||
        text.find_first_of("xX") == digit + 1)
        return {first, errc::invalid_argument};
    char* end = nullptr;
    const double read = std::strtod(text.c_str(), &end);
    if (end == text.c_str()) return {first, errc::invalid_argument};
    value = read;
    return {first + (end - text.c_str()), errc{}};
}
#endif

}  // namespace std

#endif
