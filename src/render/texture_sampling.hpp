#pragma once
/// \file
/// Texture sampling with wrap modes, bilinear filtering and mip levels.

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "faqem/asset.hpp"
#include "faqem/detail/base/parallel.hpp"

namespace faqem::detail {

/// Interpretation of the values of an image.
enum class TexelEncoding {
    color,                 ///< sRGB with alpha, filtered premultiplied
    opaque_color,          ///< sRGB; alpha is ignored and read as 1
    color_and_data_alpha,  ///< sRGB; alpha is an independent linear value
    data,                  ///< linear values in RGBA
};

/// RGBA in linear light, premultiplied with TexelEncoding::color.
using LinearColor = std::array<float, 4>;

/// An image with its mip levels. Level 0 is stored as decoded, the others with 16 bits per channel in linear
/// light, premultiplied. Memory: 4 + 8/3 bytes per texel.
class MipImage {
public:
    /// \param pixels  at least one texel
    MipImage(Pixels pixels, TexelEncoding encoding, const RunContext& context = {});

    std::uint32_t width() const { return pixels_.width; }
    std::uint32_t height() const { return pixels_.height; }

    /// Samples the image, with linear interpolation between mip levels.
    /// \param texture_ref  wrap modes and filter; its transform is not applied
    /// \param u            texture coordinate; replaced by 0 if it is not finite or beyond 1e9
    /// \param v            likewise, pointing down
    /// \param lod          log2 of the footprint in texels of level 0; clamped to the existing levels
    LinearColor sample(const TextureRef& texture_ref, double u, double v, double lod) const;

    /// Colour of the texel of level 0 at a point, whatever its alpha is. Parameters as in sample().
    Vec3f stored_color(const TextureRef& texture_ref, double u, double v) const;

private:
    struct Level {
        std::uint32_t width, height;
        std::unique_ptr<std::uint16_t[]> rgba;
    };
    // Returns visit(read) for the function read(x, y) of the texels of a level.
    template <class Visit>
    auto with_reader(std::size_t level, const Visit& visit) const;
    auto sample_level(std::size_t level, double u, double v, const TextureRef& texture_ref) const;
    Level downsample(std::size_t from, const RunContext& context) const;
    std::uint32_t width(std::size_t level) const { return level ? levels_[level - 1].width : pixels_.width; }
    std::uint32_t height(std::size_t level) const {
        return level ? levels_[level - 1].height : pixels_.height;
    }

    Pixels pixels_;
    TexelEncoding encoding_;
    std::vector<Level> levels_;  ///< starting with level 1
};

/// Images of an asset, by index and interpretation.
using DecodedImages = std::map<std::pair<Index, TexelEncoding>, std::shared_ptr<const MipImage>>;

/// An affine map of texture coordinates.
struct UvTransform {
    std::array<double, 3> u = {1, 0, 0}, v = {0, 1, 0};

    std::array<double, 2> apply(double x, double y) const {
        return {u[0] * x + u[1] * y + u[2], v[0] * x + v[1] * y + v[2]};
    }
    Vec2f apply(const Vec2f& uv) const {
        const auto [x, y] = apply(uv[0], uv[1]);
        return {static_cast<float>(x), static_cast<float>(y)};
    }
};

/// The transform of KHR_texture_transform: scale, then rotation, then offset. A positive rotation rotates UVs
/// counter-clockwise, as seen on an image with v down.
UvTransform uv_transform(const TextureRef& texture_ref);

/// Area of a triangle in UV space.
/// \param uvs  by vertex
double uv_area(const std::vector<Vec2f>& uvs, const Triangle& t);

/// wrapped_texel() of a coordinate outside the image.
inline std::uint32_t wrapped_outside(std::int64_t i, std::int64_t n, Wrap wrap) {
    if (wrap == Wrap::clamp) return static_cast<std::uint32_t>(std::clamp<std::int64_t>(i, 0, n - 1));
    const std::int64_t period = wrap == Wrap::mirror ? 2 * n : n;
    std::int64_t r = i % period;
    if (r < 0) r += period;
    return static_cast<std::uint32_t>(r < n ? r : period - 1 - r);
}

/// The column or row that a coordinate reads.
/// \param i  any
/// \param n  number of columns or rows, > 0
inline std::uint32_t wrapped_texel(std::int64_t i, std::int64_t n, Wrap wrap) {
    return i >= 0 && i < n ? static_cast<std::uint32_t>(i) : wrapped_outside(i, n, wrap);
}

/// Encodes linear light in [0, 1] as an sRGB byte. Other values are clamped; NaN gives 0.
std::uint8_t srgb_byte(double linear);

/// Encodes a value in [0, 1] as a byte. Other values are clamped; NaN gives 0.
std::uint8_t linear_byte(double value);

}  // namespace faqem::detail
