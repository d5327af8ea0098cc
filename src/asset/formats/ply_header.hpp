#pragma once
/// \file
/// The header of a PLY file.

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "asset/io/number_type.hpp"

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

}  // namespace faqem::detail
