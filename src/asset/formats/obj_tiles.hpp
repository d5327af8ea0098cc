#pragma once
/// \file
/// Textures of several images, of which each shows a tile of the UV plane (UDIM).

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "asset/formats/mtl.hpp"
#include "asset/scene/corner_vertices.hpp"
#include "faqem/mesh.hpp"

namespace faqem::detail {

/// UDIM tiles: 10 columns along u, which have consecutive numbers, and 10 rows.
inline constexpr std::uint32_t first_tile = 1001, last_tile = 1100;

/// Replaces the marks of tiles in a file name, in any letter case: `<UDIM>` and `%(UDIM)d` by the number of a tile,
/// `<UVTILE>` by its column and row from 1 (`u1_v1`). Other names are returned unchanged.
std::string tile_file_name(const std::string& name, std::uint32_t tile);

/// Gives faces whose material has a texture with a mark a material for their tile, and moves their UVs into it. A face
/// belongs to the tile of the mean of its UVs, with the placement of the first such texture. Faces across the border of
/// a tile, and those outside of all tiles, which lose these textures, are counted in a warning.
/// \param sizes      number of corners of each face
/// \param corners    of all faces; the second index is that of the UVs
/// \param materials  of the faces, indices into `names`
/// \param names      of materials; those of tiles are added, as in `skin.1002`
/// \param uvs        with v pointing down; the moved ones are added
/// \param library    receives the materials of tiles
/// \param warnings   receives the warnings
void divide_into_tiles(std::span<const std::uint32_t> sizes, std::span<CornerKey> corners,
                       std::span<Index> materials, std::vector<std::string>& names, std::vector<Vec2f>& uvs,
                       std::map<std::string, MtlMaterial>& library, std::vector<std::string>& warnings);

}  // namespace faqem::detail
