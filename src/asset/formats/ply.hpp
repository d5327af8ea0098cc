#pragma once
/// \file
/// Reading and writing of PLY files (Stanford polygon format).

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "asset/io/encoded_model.hpp"
#include "faqem/asset.hpp"

namespace faqem::detail {

/// Reads an ASCII or binary PLY file of either byte order as one part.
///
/// Supported properties:
/// - `vertex`: x y z; nx ny nz; red green blue [alpha] (also r g b a, diffuse_red ...), as integers over
///   their full range or floats in [0, 1], where the colour is sRGB and converted to linear, and alpha is
///   linear; s t (also u v, texture_u texture_v) with v' = 1 - v
/// - `face`: the list vertex_indices or vertex_index; polygons are split by triangulate(). The list texcoord, two
///   numbers for each corner, texnumber, and red green blue [alpha]: see polygon_asset(), also for `comment TextureFile`
/// - `tristrips`: the same list, with -1 between strips
///
/// Float colours above 2 are taken as 0 to 255, with a warning. Everything else is ignored. Faces with fewer than three
/// corners are left out with a warning. Counts are checked against the size of the file before memory is allocated.
/// \param bytes  content of the file, borrowed
/// \param file   path, for messages
/// \return an asset with one part, and warnings
/// \throws InputError  with the element and its index starting at 0 (`face 17`) or the line of the header, if
///                     the file is invalid; or if there are no faces
Asset read_ply(std::span<const std::uint8_t> bytes, const std::filesystem::path& file);

/// Encodes an asset as binary little-endian PLY. The scene is flattened to world space. Positions are floats
/// if all of them are representable as float, otherwise doubles; colours are 8-bit sRGB; the first UV set is
/// written as s t.
/// \param file  its name
EncodedModel encode_ply(const Asset& asset, const std::filesystem::path& file);

}  // namespace faqem::detail
