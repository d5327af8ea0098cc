/// \file
/// As libcxx13.hpp, for the half with textures: algorithms of ranges, and numbers as text.

#if __cplusplus > 201703L && !defined(FAQEM_RANGES13) && defined(FAQEM_LIBCXX13)
#define FAQEM_RANGES13

#include <algorithm>
#include <charconv>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <iterator>
#include <type_traits>

namespace std {  // NOLINT(cert-dcl58-cpp): the names are those of the standard

#if _LIBCPP_VERSION < 14000
namespace ranges {

#define FAQEM_OF_RANGE(name)                                           \
    template <class Range, class... Rest>                              \
    constexpr auto name(Range&& range, const Rest&... rest) {          \
        return std::name(std::begin(range), std::end(range), rest...); \
    }
FAQEM_OF_RANGE(all_of)
FAQEM_OF_RANGE(any_of)
FAQEM_OF_RANGE(binary_search)
FAQEM_OF_RANGE(copy)
FAQEM_OF_RANGE(count)
FAQEM_OF_RANGE(count_if)
FAQEM_OF_RANGE(fill)
FAQEM_OF_RANGE(find_if)
FAQEM_OF_RANGE(find_if_not)
FAQEM_OF_RANGE(lower_bound)
FAQEM_OF_RANGE(none_of)
FAQEM_OF_RANGE(replace)
FAQEM_OF_RANGE(transform)
#undef FAQEM_OF_RANGE

#define FAQEM_BY_PROJECTION(name)                                                                \
    template <class Range, class Compare = less, class Projection = identity>                    \
    constexpr auto name(Range&& range, Compare compare = {}, Projection projection = {}) {       \
        return std::name(std::begin(range), std::end(range), [&](const auto& a, const auto& b) { \
            return invoke(compare, invoke(projection, a), invoke(projection, b));                \
        });                                                                                      \
    }
FAQEM_BY_PROJECTION(max_element)
FAQEM_BY_PROJECTION(min_element)
FAQEM_BY_PROJECTION(minmax_element)
FAQEM_BY_PROJECTION(sort)
FAQEM_BY_PROJECTION(stable_sort)
#undef FAQEM_BY_PROJECTION

template <class Range, class Value, class Projection = identity>
constexpr auto find(Range&& range, const Value& value, Projection projection = {}) {
    return std::find_if(std::begin(range), std::end(range),
                        [&](const auto& a) { return invoke(projection, a) == value; });
}

}  // namespace ranges

inline to_chars_result to_chars(char* first, char* last, double value, chars_format format, int precision) {
    const char* const text = format == chars_format::fixed ? "%.*f" : "%.*e";
    const ptrdiff_t size = std::snprintf(first, static_cast<size_t>(last - first), text, precision, value);
    if (size >= last - first) return {last, errc::value_too_large};
    return {first + size, errc{}};
}

inline to_chars_result to_chars(char* first, char* last, double value, chars_format format) {
    to_chars_result written{last, errc::value_too_large};
    for (int digits = 0; digits < 17; ++digits) {
        written = to_chars(first, last, value, format, digits);
        if (written.ec != errc{} || std::strtod(first, nullptr) == value) break;
    }
    return written;
}
#endif

#if _LIBCPP_VERSION < 200000
/// Of numbers in text formats.
template <class Number>
enable_if_t<is_floating_point_v<Number>, from_chars_result> from_chars(const char* first, const char* last,
                                                                       Number& value) {
    auto read = static_cast<double>(value);
    const from_chars_result result = from_chars(first, last, read);
    value = static_cast<Number>(read);
    return result;
}
#endif

}  // namespace std

#endif
