#pragma once
/// \file
/// STL.

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "faqem/asset.hpp"

namespace faqem::detail {

/// Reads an STL file as one part: binary if and only if its size is 84 + 50 n for the n of byte 80, else
/// ASCII. Corners at equal positions share a vertex (-0 is 0), in the order in which they come first. The
/// normals of the facets are not read, as the corners say the same; nor are colours in attribute bytes
/// (warning where the header announces them).
/// \throws ReadError  the file cannot be read
/// \throws InputError  with the line; truncated; or no faces
Asset read_stl(const std::filesystem::path& file);

/// The same for bytes in memory. \param file  for messages
Asset read_stl(std::span<const std::uint8_t> bytes, const std::filesystem::path& file);

/// Writes binary STL of the scene flattened to world space.
/// \return what STL cannot hold, one sentence each
/// \throws WriteError
std::vector<std::string> write_stl(const Asset& asset, const std::filesystem::path& file,
                                   Overwrite overwrite);

}  // namespace faqem::detail
