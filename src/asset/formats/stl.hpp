#pragma once
/// \file
/// Reading and writing of STL files.

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "asset/io/encoded_model.hpp"
#include "faqem/asset.hpp"

namespace faqem::detail {

/// Reads an STL file as one part.
///
/// The file is binary if its size is 84 + 50 n bytes, where n is the facet count at byte 80, or if there is a
/// zero among the first 512 bytes; otherwise it is read as ASCII. If a count is 0, or more than there is room for, all
/// whole facets are read, with a warning. Colours of facets in the attributes of Magics, VisCAM and SolidView become vertex
/// colours; other attributes are ignored with a warning, and bytes after the last facet, too. Corners at equal positions share a vertex (-0 equals 0) if
/// they have the same colour; vertices are in the order of their first use. Facet normals are ignored, since
/// they follow from the positions. The solids of an ASCII file become objects of the part. Text after the last
/// solid is ignored with a warning.
/// \param bytes  content of the file, borrowed
/// \param file   path, for messages
/// \return an asset with one part, and warnings
/// \throws InputError  with the line, if an ASCII file is invalid; if a binary file is too short for a facet, or its count is
///     wrong and a coordinate not finite; if there are no faces
Asset read_stl(std::span<const std::uint8_t> bytes, const std::filesystem::path& file);

/// Encodes an asset as binary STL. The scene is flattened to world space.
/// \param file  its name
/// \throws WriteError  a coordinate exceeds the range of float
EncodedModel encode_stl(const Asset& asset, const std::filesystem::path& file);

}  // namespace faqem::detail
