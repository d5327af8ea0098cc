#pragma once
/// \file
/// Reads the values of ASCII and binary PLY files one after the other.

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>

#include "asset/formats/ply_header.hpp"
#include "asset/io/number_type.hpp"
#include "asset/text/text_scanner.hpp"
#include "faqem/error.hpp"

namespace faqem::detail {

/// Reads the values of an ASCII PLY file, where each row is a line.
class PlyAsciiData {
public:
    PlyAsciiData(std::span<const std::uint8_t> data, const std::string& file, std::uint64_t lines)
        : in_(data, file, Continuation::no, lines) {}

    /// Maximum number of rows of `values` values that the remaining bytes can hold.
    std::uint64_t max_row_count(std::uint64_t values, std::uint64_t) const {
        return (in_.remaining().size() + 1) / 2 / values;
    }
    void begin_row() { in_.skip_to_content(); }
    void end_row() { in_.finish_line(); }
    std::uint64_t remaining_bytes() {
        in_.skip_to_content();
        return in_.remaining().size();
    }
    [[noreturn]] void fail(const std::string& what) const { in_.fail(what); }

    double value(NumberType type) {
        return visit_type(type, [&](auto number) -> double { return in_.number<decltype(number)>(); });
    }

private:
    TextScanner in_;
};

/// Reads the values of a binary PLY file. Same interface as PlyAsciiData.
class PlyBinaryData {
public:
    PlyBinaryData(std::span<const std::uint8_t> data, const std::string& file, PlyFormat format)
        : at_(data.data()), end_(at_ + data.size()), file_(file), swap_(format == PlyFormat::big_endian) {}

    std::uint64_t max_row_count(std::uint64_t, std::uint64_t bytes) const {
        return remaining_bytes() / bytes;
    }
    void begin_row() {}
    void end_row() {}
    std::uint64_t remaining_bytes() const { return static_cast<std::uint64_t>(end_ - at_); }
    [[noreturn]] void fail(const std::string& what) const { throw InputError(file_ + ": " + what); }

    double value(NumberType type) {
        return visit_type(type, [&](auto number) -> double { return take<decltype(number)>(); });
    }

private:
    template <class T>
    T take() {
        if (remaining_bytes() < sizeof(T)) fail("unexpected end of the file");
        std::array<std::uint8_t, sizeof(T)> bytes;
        std::memcpy(bytes.data(), at_, sizeof(T));
        at_ += sizeof(T);
        if (swap_) std::reverse(bytes.begin(), bytes.end());
        return std::bit_cast<T>(bytes);
    }

    const std::uint8_t* at_;
    const std::uint8_t* end_;
    std::string file_;
    bool swap_;
};

}  // namespace faqem::detail
