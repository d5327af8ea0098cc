#pragma once
/// \file
/// Binary input and output of collapse histories, see docs/history-format.md.

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <istream>
#include <ostream>
#include <string>
#include <vector>

#include "faqem/error.hpp"
#include "faqem/export.hpp"
#include "faqem/history.hpp"

FAQEM_DETAIL_BEGIN

static_assert(std::endian::native == std::endian::little, "the history format is little-endian");
static_assert(sizeof(Vec3) == 24 && sizeof(Triangle) == 12);

/// The first bytes of a file; they identify the format and its version.
using HistoryMagic = std::array<char, 8>;

/// A single history.
inline constexpr HistoryMagic history_magic = {'F', 'A', 'Q', 'E', 'M', 'H', '0', '3'};
/// A history with the levels of a chain.
inline constexpr HistoryMagic chain_magic = {'F', 'A', 'Q', 'E', 'M', 'L', '0', '1'};

/// \param section  invalid section or element
/// \param what     what is wrong with it
/// \throws InputError  always
[[noreturn]] inline void fail_history(const std::string& section, const std::string& what) {
    throw InputError("history", section, what);
}

/// Writes the bytes of a value.
template <class T>
void put(std::ostream& out, const T& value) {
    out.write(reinterpret_cast<const char*>(&value), sizeof value);
}

/// Writes the number of elements as 64-bit integer, then the elements.
template <class T>
void put_array(std::ostream& out, const std::vector<T>& values) {
    put(out, static_cast<std::uint64_t>(values.size()));
    out.write(reinterpret_cast<const char*>(values.data()),
              static_cast<std::streamsize>(values.size() * sizeof(T)));
}

/// \throws InputError  if fewer than `size` bytes are left
inline void get_bytes(std::istream& in, void* to, std::size_t size, const char* section) {
    in.read(static_cast<char*>(to), static_cast<std::streamsize>(size));
    if (static_cast<std::size_t>(in.gcount()) != size) fail_history(section, "ends too early");
}

/// Reads a value that put() wrote.
/// \throws InputError  if the stream ends before
template <class T>
T get(std::istream& in, const char* section) {
    T value = {};
    get_bytes(in, &value, sizeof value, section);
    return value;
}

/// Reads an array that put_array() wrote. Reads 1 MiB at a time, so that an invalid count does not allocate
/// more memory than there are bytes in the stream.
/// \throws InputError  if the stream ends before
template <class T>
std::vector<T> get_array(std::istream& in, const char* section) {
    constexpr std::uint64_t piece = (1u << 20) / sizeof(T);
    const auto count = get<std::uint64_t>(in, section);
    std::vector<T> values;
    while (values.size() < count) {
        const std::size_t begin = values.size();
        const std::size_t size = static_cast<std::size_t>(std::min(piece, count - begin));
        values.resize(begin + size);
        get_bytes(in, values.data() + begin, size * sizeof(T), section);
    }
    return values;
}

/// Reads and validates a history, starting after its magic bytes.
/// \throws InputError  if the history is truncated or invalid
CollapseHistory read_history_body(std::istream& in);

FAQEM_DETAIL_END
