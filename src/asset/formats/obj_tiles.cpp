#include "asset/formats/obj_tiles.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <string_view>
#include <utility>

#include "asset/scene/messages.hpp"
#include "asset/scene/value_numbers.hpp"
#include "faqem/detail/base/lower_case.hpp"

namespace faqem::detail {
namespace {

constexpr double tile_columns = 10, tile_rows = 10;
using UvPoint = std::array<double, 2>;  // v pointing up

constexpr std::array<MtlTexture MtlMaterial::*, 7> texture_members = {
    &MtlMaterial::color, &MtlMaterial::alpha,     &MtlMaterial::emissive, &MtlMaterial::normal,
    &MtlMaterial::bump,  &MtlMaterial::roughness, &MtlMaterial::metallic};

bool is_tiled(const MtlTexture& texture) { return tile_file_name(texture.file, first_tile) != texture.file; }

/// The first texture with a mark; null if there is none.
const MtlTexture* leading_tiles(const MtlMaterial& material) {
    for (const auto member : texture_members)
        if (is_tiled(material.*member)) return &(material.*member);
    return nullptr;
}

/// A tile by its column and row, and by what its UVs are moved.
struct UdimTile {
    UvPoint place = {0, 0}, shift = {0, 0};
    bool exists = false;

    std::uint32_t number() const {
        return first_tile + static_cast<std::uint32_t>(place[0] + tile_columns * place[1]);
    }
};

/// The material of a tile: textures keep what they show when the UVs are moved.
MtlMaterial material_of_tile(const MtlMaterial& material, const UdimTile& tile, const std::string& name) {
    MtlMaterial result = material;
    result.values.name = name;
    for (const auto member : texture_members) {
        MtlTexture& texture = result.*member;
        const bool has_tiles = is_tiled(texture);
        if (has_tiles && !tile.exists) texture = {};
        if (!tile.exists || texture.file.empty()) continue;
        for (std::size_t k = 0; k < 2; ++k) {
            const double moved = texture.scale[k] * tile.shift[k];
            const double whole = texture.wrap == Wrap::repeat ? std::round(moved) : 0;
            texture.offset[k] += static_cast<float>(moved - (has_tiles ? tile.place[k] : whole));
        }
        if (!has_tiles) continue;
        texture.file = tile_file_name(texture.file, tile.number());
        texture.wrap = Wrap::clamp;  // filters do not mix opposite sides of the image
    }
    return result;
}

/// A corner's UVs where a texture is placed.
UvPoint placed(const MtlTexture& texture, const Vec2f& uv) {
    return {texture.offset[0] + double{texture.scale[0]} * uv[0],
            texture.offset[1] + double{texture.scale[1]} * (1 - double{uv[1]})};
}

/// The tile of a face. Sets whether the face has corners beyond it.
UdimTile tile_of(const MtlTexture& texture, std::span<const CornerKey> face, std::span<const Vec2f> uvs,
                 bool& is_across) {
    constexpr double rounding = 1e-4;
    std::vector<UvPoint> points;
    UvPoint mean = {0, 0};
    for (const CornerKey& corner : face)
        if (corner[1] != no_index) points.push_back(placed(texture, uvs[corner[1]]));
    for (const UvPoint& p : points)
        for (std::size_t k = 0; k < 2; ++k) mean[k] += p[k] / static_cast<double>(points.size());
    UdimTile tile;
    tile.exists = mean[0] >= 0 && mean[0] < tile_columns && mean[1] >= 0 && mean[1] < tile_rows;
    if (!tile.exists) return tile;
    for (std::size_t k = 0; k < 2; ++k) {
        tile.place[k] = std::floor(mean[k]);
        tile.shift[k] = texture.scale[k] == 0 ? 0 : tile.place[k] / texture.scale[k];
        for (const UvPoint& p : points)
            is_across = is_across || !(std::abs(p[k] - tile.place[k] - 0.5) <= 0.5 + rounding);
    }
    return tile;
}

}  // namespace

std::string tile_file_name(const std::string& name, std::uint32_t tile) {
    const std::uint32_t number = tile - first_tile;
    const std::array<std::pair<std::string_view, std::string>, 3> marks = {
        {{"<udim>", std::to_string(tile)},
         {"%(udim)d", std::to_string(tile)},
         {"<uvtile>", "u" + std::to_string(number % 10 + 1) + "_v" + std::to_string(number / 10 + 1)}}};
    std::string result = name;
    for (const auto& [mark, value] : marks) {
        const std::string lower = lower_case(result);
        std::size_t at = lower.size();
        while (at > 0 && (at = lower.rfind(mark, at - 1)) != std::string::npos)
            result.replace(at, mark.size(), value);
    }
    return result;
}

void divide_into_tiles(std::span<const std::uint32_t> sizes, std::span<CornerKey> corners,
                       std::span<Index> materials, std::vector<std::string>& names, std::vector<Vec2f>& uvs,
                       std::map<std::string, MtlMaterial>& library, std::vector<std::string>& warnings) {
    std::vector<const MtlMaterial*> tiled(names.size(), nullptr);
    for (std::size_t m = 0; m < tiled.size(); ++m) {
        const auto known = library.find(names[m]);
        if (known != library.end() && leading_tiles(known->second)) tiled[m] = &known->second;
    }
    std::map<std::pair<Index, std::uint32_t>, Index> added;  // by material and tile, 0 outside of all
    UniqueValues<Vec2f> moved;
    const auto first_moved = static_cast<Index>(uvs.size());
    std::uint64_t across = 0, outside = 0;
    std::size_t first = 0;
    for (std::size_t f = 0; f < sizes.size(); first += sizes[f++]) {
        const Index m = materials[f];
        if (m == no_index || !tiled[m]) continue;
        const std::span<CornerKey> face = corners.subspan(first, sizes[f]);
        bool is_across = false;
        const UdimTile tile = tile_of(*leading_tiles(*tiled[m]), face, uvs, is_across);
        across += is_across;
        outside += !tile.exists;
        const std::uint32_t number = tile.exists ? tile.number() : 0;
        const auto [entry, is_new] = added.try_emplace({m, number}, static_cast<Index>(names.size()));
        materials[f] = entry->second;
        if (is_new) {
            std::string name = names[m] + "." + (tile.exists ? std::to_string(number) : "outside");
            while (library.contains(name)) name += '_';
            library[name] = material_of_tile(*tiled[m], tile, name);
            names.push_back(std::move(name));
        }
        for (CornerKey& corner : face) {
            if (corner[1] == no_index || tile.shift == UvPoint{0, 0}) continue;
            const Vec2f& uv = uvs[corner[1]];
            corner[1] = first_moved + moved.insert({static_cast<float>(uv[0] - tile.shift[0]),
                                                    static_cast<float>(uv[1] + tile.shift[1])});
        }
    }
    uvs.insert(uvs.end(), moved.values().begin(), moved.values().end());
    add_counted(warnings, across, "face",
                " across borders of UDIM tiles: the whole face has the texture of one of them");
    add_counted(warnings, outside, "face",
                " outside of the UDIM tiles " + std::to_string(first_tile) + " to " +
                    std::to_string(last_tile) + ": textures left out");
}

}  // namespace faqem::detail
