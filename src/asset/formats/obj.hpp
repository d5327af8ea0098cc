#pragma once
/// \file
/// Wavefront OBJ.

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "faqem/asset.hpp"

namespace faqem::detail {

/// Reads an OBJ file as one part, so that no crack opens between its objects; the first object names it.
/// Vertex i of the part is `v` number i with the vt and vn of its first corner; corners of `v` i with another
/// vt or vn get vertices after all those, in the order of the faces. Polygons are split by triangulate().
/// Colours after a position are display values (sRGB) in 0..1 and are made linear; vertices without are
/// white. UVs: v' = 1 - v. Materials: see read_mtl(); one the libraries lack, or a missing library, is a
/// warning. Lines, points and unknown statements are skipped with a counted warning; so are faces of fewer
/// than three corners.
/// \throws ReadError  the file cannot be read
/// \throws InputError  with the line: not a number, index 0 or out of range, mixed corner forms; or no faces
Asset read_obj(const std::filesystem::path& file);

/// The same for bytes in memory. \param file  for messages; its folder is searched for libraries and images
Asset read_obj(std::span<const std::uint8_t> text, const std::filesystem::path& file);

/// Writes NAME.obj, and where it has materials NAME.mtl and images NAME_0.png ..., the OBJ file last. The
/// scene is flattened to world space. Positions are written as float where all are floats, else as double;
/// equal positions, UVs and normals share a line.
/// \return what OBJ cannot hold, one sentence each
/// \throws WriteError
std::vector<std::string> write_obj(const Asset& asset, const std::filesystem::path& file,
                                   Overwrite overwrite);

}  // namespace faqem::detail
