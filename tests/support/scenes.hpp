#pragma once
/// \file
/// Small textured scenes, and simplified parts that equal the source.

#include <cmath>
#include <functional>

#include "faqem/bake.hpp"
#include "support/hand_history.hpp"
#include "support/meshes.hpp"

namespace faqem::test {

using Rgba = std::array<std::uint8_t, 4>;

/// An image with the colours color(x, y).
inline Pixels paint(std::uint32_t width, std::uint32_t height,
                    const std::function<Rgba(std::uint32_t x, std::uint32_t y)>& color) {
    Pixels pixels{width, height, {}, false};
    for (std::uint32_t y = 0; y < height; ++y) {
        for (std::uint32_t x = 0; x < width; ++x) {
            for (std::uint8_t c : color(x, y)) pixels.rgba.push_back(c);
            pixels.has_alpha = pixels.has_alpha || pixels.rgba.back() != 255;
        }
    }
    return pixels;
}

// A square image in which red increases with x and green with y.
inline Pixels ramp(std::uint32_t size) {
    return paint(size, size, [&](std::uint32_t x, std::uint32_t y) {
        return Rgba{static_cast<std::uint8_t>(60 + x * 180 / (size - 1)),
                    static_cast<std::uint8_t>(60 + y * 180 / (size - 1)), 90, 255};
    });
}

inline Index add_texture(Asset& asset, const Pixels& pixels) {
    asset.images.push_back(encode_png(pixels, "image" + std::to_string(asset.images.size())));
    return static_cast<Index>(asset.images.size() - 1);
}

// 3--2   A unit square in the plane z = 0; vertex 3 has UV (0, 0), and v points down.
// | /|
// 0--1
inline Part square() {
    Part part;
    part.name = "square";
    part.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    part.triangles = {{0, 1, 2}, {0, 2, 3}};
    part.uvs = {{{0, 1}, {1, 1}, {1, 0}, {0, 0}}};
    part.face_material = {0, 0};
    return part;
}

/// An asset with parts alone.
inline Asset asset_with(std::vector<Part> parts) {
    Asset asset;
    asset.parts = std::move(parts);
    return asset;
}

/// A mesh as a part, whose faces have a material or none.
inline Part part_of(const TriangleMesh& mesh, Index material = no_index) {
    Part part;
    part.positions = mesh.positions;
    part.triangles = mesh.triangles;
    part.face_material.assign(mesh.triangles.size(), material);
    return part;
}

// A surface of 2 n^2 faces: the grid point (x, y) in [0, n]^2 has the position place(x, y).
inline Part sheet(Index n, const std::function<Vec3(double x, double y)>& place) {
    Part part = part_of(grid(n));
    part.face_material.clear();
    for (Vec3& p : part.positions) p = place(p[0], p[1]);
    return part;
}

/// The part with material 0, and with the UVs uv_of(position), v pointing down.
template <class UvOf>
Part uv_mapped(Part part, const UvOf& uv_of) {
    part.uvs.assign(1, {});
    for (const Vec3& p : part.positions) {
        const std::array<double, 2> uv = uv_of(p);
        part.uvs[0].push_back({static_cast<float>(uv[0]), static_cast<float>(uv[1])});
    }
    part.face_material.assign(part.triangles.size(), 0);
    return part;
}

/// The part with material 0, and with x and y as UVs.
inline Part uv_mapped(Part part) {
    return uv_mapped(std::move(part), [](const Vec3& p) { return std::array{p[0], p[1]}; });
}

/// An asset of a part whose material 0 has an image.
inline Asset textured(const Pixels& pixels, Part part) {
    Asset asset;
    asset.materials.resize(1);
    asset.materials[0].name = "paint";
    asset.materials[0].metallic = 0;
    TextureRef& use = asset.materials[0].base_color_texture;
    use.image = add_texture(asset, pixels);
    use.wrap_u = use.wrap_v = Wrap::clamp;
    asset.parts = {std::move(part)};
    return asset;
}

inline Asset textured_square(const Pixels& pixels) { return textured(pixels, square()); }

/// Options of which the images are the baked texels.
inline Options lossless(std::uint32_t texture_size = BakeOptions().texture_size) {
    return {.bake = {.texture_size = texture_size, .image_format = ImageFormat::png}};
}

/// The parts of an asset as simplified parts without collapses. Vertices are not welded.
inline SimplifiedParts unchanged(const Asset& asset) {
    SimplifiedParts simplified;
    for (const Part& part : asset.parts) {
        SimplifyResult result;
        result.history = HandHistory(part.positions, part.triangles).finish();
        result.mesh = small_mesh(result.history);
        simplified.parts.push_back(std::move(result));
    }
    return simplified;
}

/// As unchanged(), with vertices at equal positions welded as in simplify().
inline SimplifiedParts unchanged_welded(const Asset& asset) {
    Asset welded = asset;
    for (Part& part : welded.parts) {
        for (Triangle& t : part.triangles) {
            for (Index& v : t) {
                Index first = 0;
                while (part.positions[first] != part.positions[v]) ++first;
                v = first;
            }
        }
    }
    return unchanged(welded);
}

/// Bilinear sample of an image in [0, 255], without mipmaps.
inline std::array<double, 4> read(const Pixels& pixels, double u, double v) {
    const double x = u * pixels.width - 0.5, y = v * pixels.height - 0.5;
    const double x0 = std::floor(x), y0 = std::floor(y), s = x - x0, t = y - y0;
    std::array<double, 4> result{};
    for (int j = 0; j < 2; ++j) {
        for (int i = 0; i < 2; ++i) {
            const auto column = static_cast<std::size_t>(std::min(std::max(x0 + i, 0.0), pixels.width - 1.0));
            const auto row = static_cast<std::size_t>(std::min(std::max(y0 + j, 0.0), pixels.height - 1.0));
            const double weight = (i ? s : 1 - s) * (j ? t : 1 - t);
            for (std::size_t k = 0; k < 4; ++k)
                result[k] += weight * pixels.rgba[4 * (row * pixels.width + column) + k];
        }
    }
    return result;
}

/// Interpolates values per vertex at a point of a triangle.
/// \param w  barycentric coordinates
template <class V>
auto blend(const std::vector<V>& values, const Triangle& t, const Vec3& w) {
    std::array<double, std::tuple_size_v<V>> result{};
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t k = 0; k < result.size(); ++k) result[k] += w[i] * values[t[i]][k];
    }
    return result;
}

/// The base colour of a material as an image: that of its texture or, if it has none, one texel of its factor.
inline Pixels base_color_image(const Asset& asset, std::size_t material = 0) {
    const Material& m = asset.materials.at(material);
    if (m.base_color_texture) return decode(asset.images.at(m.base_color_texture.image));
    Rgba texel;
    for (std::size_t k = 0; k < 4; ++k) {
        const double c = m.base_color[k];
        const double value = k == 3 ? c : c <= 0.0031308 ? 12.92 * c : 1.055 * std::pow(c, 1 / 2.4) - 0.055;
        texel[k] = static_cast<std::uint8_t>(std::lround(255 * value));
    }
    return paint(1, 1, [&](std::uint32_t, std::uint32_t) { return texel; });
}

/// The texture colour at a point of a face, in [0, 255]. Without UVs, that of the first texel.
/// \param w  barycentric coordinates
inline std::array<double, 4> look(const Part& part, const Pixels& pixels, std::size_t face, const Vec3& w) {
    if (part.uvs.empty()) return read(pixels, 0, 0);
    const auto uv = blend(part.uvs[0], part.triangles[face], w);
    return read(pixels, uv[0], uv[1]);
}

}  // namespace faqem::test
