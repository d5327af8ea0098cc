#pragma once
/// \file
/// Reading of OFF files (Object File Format of Geomview).

#include <cstdint>
#include <filesystem>
#include <span>

#include "faqem/asset.hpp"

namespace faqem::detail {

/// Reads an ASCII OFF file as one part: OFF, STOFF, COFF, NOFF and their combinations (ST, then C, then N).
///
/// The keyword and the number of edges may be missing, the counts may be on the line of the keyword, and
/// comments (`#`) may be anywhere. A vertex line holds x y z, then the normal (N), then the colour (C: three or
/// four integers in [0, 255] or floats in [0, 1]; sRGB, converted to linear), then s t (ST; v' = 1 - v).
/// Colours of faces, likewise with three or four components, become vertex colours unless vertices have
/// colours; faces without one are white. Indices into a colour map are ignored with a warning. Polygons are
/// split by triangulate(). Faces with fewer than three corners are left out with a warning. Source: Geomview
/// manual, "OFF Files".
/// \param text  content of the file, borrowed
/// \param file  path, for messages
/// \return an asset with one part, and warnings
/// \throws InputError        with the line, if the file is invalid; or if there are no faces
/// \throws UnsupportedError  4OFF, nOFF or binary OFF
Asset read_off(std::span<const std::uint8_t> text, const std::filesystem::path& file);

}  // namespace faqem::detail
