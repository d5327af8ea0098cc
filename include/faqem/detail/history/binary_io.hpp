#pragma once
/// \file
/// Arrays in the files of histories.

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

FAQEM_NAMESPACE_BEGIN
namespace detail {

static_assert(std::endian::native == std::endian::little, "the history format is written byte for byte");
static_assert(sizeof(Vec3) == 24 && sizeof(Triangle) == 12);

/// The first bytes of a section.
using HistoryMagic = std::array<char, 8>;

inline constexpr HistoryMagic history_magic = {'F', 'A', 'Q', 'E', 'M', 'H', '0', '3'};
inline constexpr HistoryMagic chain_magic = {'F', 'A', 'Q', 'E', 'M', 'L', '0', '1'};

[[noreturn]] inline void fail_history(const std::string& section, const std::string& what) {
    throw InputError("history", section, what);
}

template <class T>
void put(std::ostream& out, const T& value) {
    out.write(reinterpret_cast<const char*>(&value), sizeof value);
}

template <class T>
void put_array(std::ostream& out, const std::vector<T>& values) {
    put(out, static_cast<std::uint64_t>(values.size()));
    out.write(reinterpret_cast<const char*>(values.data()),
              static_cast<std::streamsize>(values.size() * sizeof(T)));
}

inline void get_bytes(std::istream& in, void* to, std::size_t size, const char* section) {
    in.read(static_cast<char*>(to), static_cast<std::streamsize>(size));
    if (static_cast<std::size_t>(in.gcount()) != size) fail_history(section, "ends too early");
}

template <class T>
T get(std::istream& in, const char* section) {
    T value = {};
    get_bytes(in, &value, sizeof value, section);
    return value;
}

/// Reads in pieces, so that a count that lies costs no more memory than the bytes that follow.
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

/// What follows the magic of a history; it is validated.
CollapseHistory read_history_body(std::istream& in);

}  // namespace detail
FAQEM_NAMESPACE_END
