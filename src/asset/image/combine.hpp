#pragma once
/// \file
/// Images of glTF materials, made of images that other formats keep apart: masks, heights, roughness and metal.

#include <cstdint>
#include <vector>

#include "faqem/asset.hpp"
#include "faqem/export.hpp"

namespace faqem::detail {

/// Which value of a pixel a scalar texture means.
enum class ScalarChannel {
    automatic,  ///< alpha if a pixel is transparent, otherwise luminance
    red,
    green,
    blue,
    alpha,
    luminance  ///< 0.2126 R + 0.7152 G + 0.0722 B, of the values as stored
};

/// Two texels next to each other that are interpolated.
struct Tap {
    std::uint32_t first, second;
    double share;  ///< of the second
};

/// Bilinear interpolation along one axis: what to take for each of `to` texels from `from` texels. O(to)
/// \param repeats  whether the last texel is followed by the first
FAQEM_EXPORT std::vector<Tap> taps_of(std::uint32_t from, std::uint32_t to, bool repeats = false);

/// A scalar image with values from 0 to 255, top row first.
struct ScalarImage {
    std::uint32_t width = 0, height = 0;
    std::vector<std::uint8_t> values;  ///< width * height
};

/// Extracts the values of a scalar texture.
ScalarImage scalar_image(const Pixels& pixels, ScalarChannel channel);

/// Whether red, green and blue of every pixel are equal.
bool is_grey(const Pixels& pixels);

/// Whether the pixels are directions (n + 1) / 2 rather than heights or colours: not grey, and at least half of
/// them have a length within 0.25 of 1 and do not point inwards.
bool is_normal_map(const Pixels& pixels);

/// Replaces the alpha. The smaller image is scaled bilinearly to the larger width and height.
/// \param color  at least one pixel
/// \param alpha  at least one value
Pixels with_alpha(const Pixels& color, const ScalarImage& alpha);

/// Packs roughness (green) and metal (blue) as in glTF; red is 255, as is a channel without an image. Sizes as in
/// with_alpha().
/// \pre at least one of the images is not empty
Pixels roughness_metallic(const ScalarImage& roughness, const ScalarImage& metallic);

/// Computes the tangent-space normal map of a height map that repeats, with y up as in glTF, from central differences:
/// the normal is (-depth dh/du, -depth dh/dv, 1), for h from 0 to 1 and texture coordinates u to the right and v up.
/// \param depth  height of white above black, in the unit of the texture coordinates
Pixels normals_of_heights(const ScalarImage& heights, double depth);

}  // namespace faqem::detail
