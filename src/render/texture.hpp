#pragma once
/// \file
/// Textures of the rasterizer: mipmaps with trilinear sampling.

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "faqem/asset.hpp"

namespace faqem::render {

/// Encoding of the RGB channels of a texture.
enum class ColorSpace {
    srgb,   ///< colours; filtered in linear light
    linear  ///< data such as normals
};

/// A mipmapped texture; empty if it has no levels.
struct Texture {
    /// A mip level, 8 bits per channel.
    struct Level {
        std::uint32_t width = 0, height = 0;
        std::vector<std::uint8_t> rgba;  ///< width * height * 4
    };
    std::vector<Level> levels;  ///< from fine to coarse, each half the size of the one before; at most four
    ColorSpace color_space = ColorSpace::srgb;

    explicit operator bool() const { return !levels.empty(); }
};

/// Builds the mip levels of an image. An image without pixels gives an empty texture.
Texture make_texture(Pixels pixels, ColorSpace color_space);

/// Applies the KHR_texture_transform of a texture reference to a UV.
Eigen::Vector2d transform_uv(const TextureRef& texture_ref, const Eigen::Vector2d& uv);

/// Samples a texture with the wrap modes and the filter of the texture reference.
/// \param texture      a non-empty texture
/// \param texture_ref  wrap modes and filter; its transform is not applied
/// \param uv           transformed UV, v pointing down; (0, 0) is the outer corner of the first texel
/// \param lod          mip level, clamped to the existing levels and interpolated; 0: full resolution
/// \return RGBA in [0, 1], colours in linear light
Eigen::Vector4f sample(const Texture& texture, const TextureRef& texture_ref, const Eigen::Vector2d& uv,
                       double lod);

}  // namespace faqem::render
