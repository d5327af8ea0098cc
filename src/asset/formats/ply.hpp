#pragma once
/// \file
/// PLY, the Stanford polygon format.

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "faqem/asset.hpp"

namespace faqem::detail {

/// Reads ASCII and binary PLY of both byte orders as one part.
/// Of the element `vertex`: x y z; nx ny nz; red green blue [alpha] (also r g b a, diffuse_red ...), as
/// integers over their whole range or as floats in 0..1, display values (sRGB) that are made linear, alpha
/// linear; s t (also u v, texture_u texture_v), v' = 1 - v. Of `face`: the list vertex_indices or
/// vertex_index, polygons split by triangulate(). Of `tristrips`: the same list with -1 between strips.
/// Everything else is skipped; UVs and colours of faces with a warning. Faces of fewer than three corners are
/// left out with a warning. Every count is checked against the size of the file before memory is taken.
/// \throws ReadError    the file cannot be read
/// \throws InputError   naming the element and its number (`face 17`), from 0, or the line of the header; or
///                      no faces
Asset read_ply(const std::filesystem::path& file);

/// The same for bytes in memory. \param file  for messages
Asset read_ply(std::span<const std::uint8_t> bytes, const std::filesystem::path& file);

/// Writes binary little-endian PLY of the scene flattened to world space. Positions are floats where all are
/// exactly floats, else doubles; colours are 8-bit sRGB; the first UV set is written as s t.
/// \return what PLY cannot hold, one sentence each
/// \throws WriteError
std::vector<std::string> write_ply(const Asset& asset, const std::filesystem::path& file,
                                   Overwrite overwrite);

}  // namespace faqem::detail
