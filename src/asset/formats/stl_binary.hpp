#pragma once
/// \file
/// The facets of binary STL files, with their colours.

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "faqem/asset.hpp"

namespace faqem::detail {

inline constexpr std::size_t stl_header_bytes = 84, facet_bytes = 50;

/// The content of a binary STL file.
struct BinaryStl {
    std::span<const std::uint8_t> bytes;  ///< the file, borrowed
    std::size_t facets = 0;
    std::vector<Vec4f> colors;  ///< by facet, linear; empty: the file has none

    /// The corners of a facet.
    std::array<Vec3, 3> corners(std::size_t facet) const;
};

/// Reads the header and the colours of a binary STL file.
///
/// The file has as many facets as the count at byte 80 says. If it is 0, or more than there is room for, all
/// whole facets of the file are read. A warning says so, and that bytes after the last facet are ignored.
///
/// The 16 attribute bits of a facet are a colour, 5 bits each for red, green and blue, which are sRGB. Magics:
/// if the header contains `COLOR=`, followed by RGBA as bytes, red has the lowest bits, and facets with the
/// highest bit set have the colour of the header. VisCAM and SolidView: otherwise, if a facet has the highest
/// bit set; these have a colour, with blue in the lowest bits, and the others are white. Other attributes are
/// ignored with a warning.
/// \param bytes     borrowed
/// \param file      path for messages
/// \param warnings  receives the warnings
/// \throws InputError  the file is too short for a header and a facet, or its count is wrong and a coordinate
///                     is not finite, so that it is hardly STL
BinaryStl read_binary_stl(std::span<const std::uint8_t> bytes, const std::string& file,
                          std::vector<std::string>& warnings);

}  // namespace faqem::detail
