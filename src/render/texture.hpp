#pragma once
/// \file
/// Textures for the rasteriser: mip pyramids with trilinear sampling.

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "faqem/asset.hpp"

namespace faqem::render {

enum class ColorSpace {
    srgb,   ///< colours: averaged and interpolated in linear light
    linear  ///< data: normals
};

/// An image and its halves. Empty: no levels.
struct Texture {
    struct Level {
        std::uint32_t width = 0, height = 0;
        std::vector<std::uint8_t> rgba;
    };
    std::vector<Level> levels;
    ColorSpace color_space = ColorSpace::srgb;

    explicit operator bool() const { return !levels.empty(); }
};

Texture make_texture(Pixels pixels, ColorSpace color_space);

/// KHR_texture_transform.
Eigen::Vector2d transform_uv(const TextureRef& texture_ref, const Eigen::Vector2d& uv);

/// \param uv   transform_uv, v pointing down, (0, 0) the outer corner of the first texel
/// \param lod  0: the full image, 1: half of it ...
/// \return RGBA in [0, 1], colours in linear light
Eigen::Vector4f sample(const Texture& texture, const TextureRef& texture_ref, const Eigen::Vector2d& uv,
                       double lod);

}  // namespace faqem::render
