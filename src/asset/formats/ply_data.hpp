#pragma once
/// \file
/// Reads the values of ASCII and binary PLY files one after the other.

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>

#include "asset/formats/ply_header.hpp"
#include "asset/text/text_scanner.hpp"
#include "faqem/error.hpp"

namespace faqem::detail {

/// Smallest and largest value of an integer type.
struct PlyTypeRange {
    double low, high;
};

inline PlyTypeRange ply_type_range(PlyType type) {
    static constexpr std::array<PlyTypeRange, 6> ranges = {{{-128, 127},
                                                            {0, 255},
                                                            {-32768, 32767},
                                                            {0, 65535},
                                                            {-2147483648.0, 2147483647.0},
                                                            {0, 4294967295.0}}};
    return ranges[static_cast<std::size_t>(type)];
}

inline bool is_integer_type(PlyType type) { return type != PlyType::float32 && type != PlyType::float64; }

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

    double value(PlyType type) {
        if (type == PlyType::float64) return in_.number<double>();
        if (type == PlyType::float32) return in_.number<float>();
        const auto value = static_cast<double>(in_.number<std::int64_t>());
        const PlyTypeRange range = ply_type_range(type);
        if (value < range.low || value > range.high)
            in_.fail("a value does not fit the type of its property");
        return value;
    }

private:
    TextScanner in_;
};

/// Reads the values of a binary PLY file. Same interface as PlyAsciiData.
class PlyBinaryData {
public:
    PlyBinaryData(std::span<const std::uint8_t> data, const std::string& file, PlyFormat format)
        : at_(data.data()),
          end_(at_ + data.size()),
          file_(file),
          swap_((format == PlyFormat::big_endian) != (std::endian::native == std::endian::big)) {}

    std::uint64_t max_row_count(std::uint64_t, std::uint64_t bytes) const {
        return remaining_bytes() / bytes;
    }
    void begin_row() {}
    void end_row() {}
    std::uint64_t remaining_bytes() const { return static_cast<std::uint64_t>(end_ - at_); }
    [[noreturn]] void fail(const std::string& what) const { throw InputError(file_ + ": " + what); }

    double value(PlyType type) {
        switch (type) {
            case PlyType::int8:
                return take<std::int8_t>();
            case PlyType::uint8:
                return take<std::uint8_t>();
            case PlyType::int16:
                return take<std::int16_t>();
            case PlyType::uint16:
                return take<std::uint16_t>();
            case PlyType::int32:
                return take<std::int32_t>();
            case PlyType::uint32:
                return take<std::uint32_t>();
            case PlyType::float32:
                return take<float>();
            case PlyType::float64:
                break;
        }
        return take<double>();
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
