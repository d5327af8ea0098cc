#pragma once
/// \file
/// Numbers in binary files: their types, and their bytes with the least significant one first.

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <vector>

namespace faqem::detail {

/// With the constants that glTF has for those other than i32 and f64.
enum class NumberType : std::uint32_t { i8 = 5120, u8, i16, u16, i32, u32, f32, f64 };

/// Whether the numbers are integers.
constexpr bool is_integer(NumberType type) { return type < NumberType::f32; }

/// Calls visit(T()) for the type T of the numbers, and returns the result.
template <class Visit>
auto visit_type(NumberType type, const Visit& visit) {
    if (type == NumberType::i8) return visit(std::int8_t());
    if (type == NumberType::u8) return visit(std::uint8_t());
    if (type == NumberType::i16) return visit(std::int16_t());
    if (type == NumberType::u16) return visit(std::uint16_t());
    if (type == NumberType::i32) return visit(std::int32_t());
    if (type == NumberType::u32) return visit(std::uint32_t());
    if (type == NumberType::f64) return visit(double());
    return visit(float());
}

/// Size of a number in bytes.
inline std::size_t number_size(NumberType type) {
    return visit_type(type, [](auto number) { return sizeof number; });
}

static_assert(std::endian::native == std::endian::little, "numbers are copied without conversion");

/// The number in the bytes from an address on.
template <class T>
T load_number(const std::uint8_t* bytes) {
    T value;
    std::memcpy(&value, bytes, sizeof value);
    return value;
}

/// The integer in the four bytes from the position `at` on.
/// \pre at + 4 <= bytes.size()
inline std::uint32_t u32_at(std::span<const std::uint8_t> bytes, std::uint64_t at) {
    return load_number<std::uint32_t>(&bytes[at]);
}

/// The floats in some bytes.
inline std::vector<float> floats_of(std::span<const std::uint8_t> bytes) {
    std::vector<float> floats(bytes.size() / sizeof(float));
    if (!floats.empty()) std::memcpy(floats.data(), bytes.data(), floats.size() * sizeof(float));
    return floats;
}

/// Appends the bytes of a number.
template <class T>
void put_number(std::vector<std::uint8_t>& bytes, T value) {
    const auto raw = std::bit_cast<std::array<std::uint8_t, sizeof(T)>>(value);
    bytes.insert(bytes.end(), raw.begin(), raw.end());
}

}  // namespace faqem::detail
