#pragma once
/// \file
/// Types of numbers in binary files.

#include <cstddef>
#include <cstdint>

namespace faqem::detail {

/// With the constants that glTF has for those other than i32 and f64.
enum class NumberType : std::uint32_t { i8 = 5120, u8, i16, u16, i32, u32, f32, f64 };

/// Whether the numbers are integers.
constexpr bool is_integer(NumberType type) { return type < NumberType::f32; }

/// Calls visit(T()) for the type T of the numbers, and returns the result.
template <class Visit>
auto visit_type(NumberType type, const Visit& visit) {
    switch (type) {
        case NumberType::i8:
            return visit(std::int8_t());
        case NumberType::u8:
            return visit(std::uint8_t());
        case NumberType::i16:
            return visit(std::int16_t());
        case NumberType::u16:
            return visit(std::uint16_t());
        case NumberType::i32:
            return visit(std::int32_t());
        case NumberType::u32:
            return visit(std::uint32_t());
        case NumberType::f64:
            return visit(double());
        case NumberType::f32:
            break;
    }
    return visit(float());
}

/// Size of a number in bytes.
inline std::size_t number_size(NumberType type) {
    return visit_type(type, [](auto number) { return sizeof number; });
}

}  // namespace faqem::detail
