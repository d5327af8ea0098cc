#pragma once
/// \file
/// OFF, the Object File Format of Geomview.

#include <cstdint>
#include <filesystem>
#include <span>

#include "faqem/asset.hpp"

namespace faqem::detail {

/// Reads ASCII OFF, STOFF, COFF, NOFF and their combinations (ST, then C, then N) as one part. The keyword
/// may be missing, the counts may stand on its line, the number of edges may be missing, and comments (`#`)
/// may stand anywhere. Vertex lines hold x y z, then the normal (N), then the colour (C; integers 0..255 or
/// floats 0..1, three or four, sRGB made linear), then s t (ST; v' = 1 - v). Colours after a face are skipped
/// with a warning, polygons split by triangulate(), faces of fewer than three corners left out with a
/// warning.
/// \throws ReadError  the file cannot be read
/// \throws InputError  with the line; or no faces
/// \throws UnsupportedError  4OFF, nOFF, binary
/// Source: Geomview manual, "OFF Files".
Asset read_off(const std::filesystem::path& file);

/// The same for bytes in memory. \param file  for messages
Asset read_off(std::span<const std::uint8_t> text, const std::filesystem::path& file);

}  // namespace faqem::detail
