#pragma once
/// \file
/// Reading textures: wrap modes, bilinear filtering, footprints.

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "faqem/asset.hpp"
#include "faqem/detail/base/parallel.hpp"

namespace faqem::detail {

/// How the numbers of an image are meant.
enum class TexelEncoding {
    color,                 ///< sRGB, alpha counts: filtered premultiplied
    opaque_color,          ///< sRGB, alpha is ignored and read as 1
    color_and_data_alpha,  ///< sRGB; alpha is a number of its own
    data,                  ///< linear numbers in RGBA
};

/// RGBA in linear light, premultiplied where the encoding says so.
using LinearColor = std::array<float, 4>;

/// An image with its mip pyramid: level 0 as decoded, the others 16 bits per channel in linear light,
/// premultiplied. 4 + 8 / 3 bytes per texel.
class MipImage {
public:
    /// \param pixels  at least one texel
    /// \throws what the workers' poll throws
    MipImage(Pixels pixels, TexelEncoding encoding, const Workers& workers = {});

    std::uint32_t width() const { return pixels_.width; }
    std::uint32_t height() const { return pixels_.height; }

    /// \param texture_ref  wrap modes and filter; its transform is not applied here
    /// \param u,v  texture coordinates, v down; what is not finite or beyond 1e9 reads as 0
    /// \param lod  log2 of the footprint in texels of level 0; below 0 as 0
    LinearColor sample(const TextureRef& texture_ref, double u, double v, double lod) const;

private:
    struct Level {
        std::uint32_t width, height;
        std::unique_ptr<std::uint16_t[]> rgba;
    };
    LinearColor texel(std::size_t level, std::int64_t x, std::int64_t y, const TextureRef& texture_ref) const;
    LinearColor read(std::size_t level, std::uint32_t x, std::uint32_t y) const;
    LinearColor sample_level(std::size_t level, double u, double v, const TextureRef& texture_ref) const;
    Level downsample(std::size_t from, const Workers& workers) const;
    std::uint32_t width(std::size_t level) const { return level ? levels_[level - 1].width : pixels_.width; }
    std::uint32_t height(std::size_t level) const {
        return level ? levels_[level - 1].height : pixels_.height;
    }

    Pixels pixels_;
    TexelEncoding encoding_;
    std::vector<Level> levels_;  ///< from level 1 on
};

/// An affine map of texture coordinates.
struct UvTransform {
    std::array<double, 3> u = {1, 0, 0}, v = {0, 1, 0};

    std::array<double, 2> apply(double x, double y) const {
        return {u[0] * x + u[1] * y + u[2], v[0] * x + v[1] * y + v[2]};
    }
};

/// KHR_texture_transform: scaled, rotated, moved. A positive rotation turns UVs counter-clockwise as seen on
/// an image whose v points down.
UvTransform uv_transform(const TextureRef& texture_ref);

/// 0..1 linear light to an sRGB byte. NaN gives 0.
std::uint8_t srgb_byte(double linear);

/// 0..1 to a byte. NaN gives 0.
std::uint8_t linear_byte(double value);

}  // namespace faqem::detail
