#pragma once
/// \file
/// The header of a PLY file, and the values after it, one after the other.

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <vector>

#include "asset/io/number_type.hpp"
#include "asset/text/text_scanner.hpp"
#include "faqem/error.hpp"

namespace faqem::detail {

enum class PlyFormat { ascii, little_endian, big_endian };

struct PlyProperty {
    std::string name;
    NumberType type = NumberType::f32;  ///< type of the value, or of the items of a list
    bool is_list = false;
    NumberType count_type = NumberType::u8;  ///< type of the length of a list
};

struct PlyElement {
    std::string name;
    std::uint64_t count = 0;
    std::vector<PlyProperty> properties;
};

struct PlyHeader {
    PlyFormat format = PlyFormat::ascii;
    std::vector<PlyElement> elements;
    std::vector<std::string> texture_files;  ///< names in comments `TextureFile`, which some programs write
    std::size_t size = 0;                    ///< size of the header in bytes; the data follow
    std::uint64_t lines = 0;                 ///< number of lines of the header
};

/// Reads the header of a PLY file.
/// \param bytes  the whole file, borrowed
/// \param file   path for messages
/// \throws InputError  with the line, if the header is invalid
PlyHeader read_ply_header(std::span<const std::uint8_t> bytes, const std::string& file);

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
        return visit_type(type, [&](auto number) -> double {
            if (remaining_bytes() < sizeof(number)) fail("unexpected end of the file");
            std::array<std::uint8_t, sizeof(number)> bytes;
            std::memcpy(bytes.data(), at_, sizeof(number));
            at_ += sizeof(number);
            if (swap_) std::reverse(bytes.begin(), bytes.end());
            return std::bit_cast<decltype(number)>(bytes);
        });
    }

private:
    const std::uint8_t* at_;
    const std::uint8_t* end_;
    std::string file_;
    bool swap_;
};

}  // namespace faqem::detail
