#pragma once
/// \file
/// Encoding and resolution of baked images, chosen by the measured loss.

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "asset/scene/material_textures.hpp"
#include "bake/texture/picture_difference.hpp"
#include "faqem/asset.hpp"
#include "faqem/detail/base/parallel.hpp"
#include "faqem/options.hpp"

namespace faqem::detail {

/// Peak signal-to-noise ratios, in dB; infinity if nothing differs. That of the worst block tells whether errors are
/// concentrated where they would be seen, such as at the seams of charts.
struct ImageQuality {
    double whole;  ///< over all known texels
    double block;  ///< least one of a block of 8 x 8 texels; unknown texels of the block count as equal
};

/// How far encode_smallest() may go.
struct ImageLimits {
    ImageQuality quality;
    bool may_shrink = true;  ///< whether the result may have fewer texels
    bool tries_core = true;  ///< whether PNG and JPEG are tried, which glTF has without extensions
    bool tries_webp = false;
    std::array<bool, 2> repeats = {};  ///< see shown_quality()
};

/// Least PSNR of an image of ImageFormat::automatic: BakeOptions::image_quality, and 4 dB less for roughness and other
/// data, but not less than 30 if colours have more (docs/measurements/appearance.md, "Image formats"). Normals are
/// between, since their errors show in reflections. That of a block is 15 dB less.
/// \param roughness  of the surface, in [0, 1]; for normals
/// \param change     quality_change() for the whole image, dB; ignored if BakeOptions::image_quality is set
ImageQuality least_quality(const BakeOptions& bake, TextureContent content, double roughness,
                           double change = 0);

/// By how many dB images should be better than usual, since pictures of the result show their errors, or may be worse,
/// since these are small beside those of the faces: in [-2, 4].
/// \param pictures  of the result with perfect images; nothing if they were not compared: 0
double quality_change(const std::optional<PictureDifference>& pictures, TextureContent content);

/// Quality of an image that is shown instead of another: the differences at the texels of the other image,
/// where the first is interpolated bilinearly. Differences of colour are weighted by alpha.
/// \param original  at least one texel
/// \param shown     its sides are those of `original`, divided by the same power of two
/// \param known     by texel of `original`: nonzero for those that count
/// \param repeats   whether textures repeat the image, in x and y: texels at opposite borders are interpolated then
/// Complexity: O(texels of `original`).
ImageQuality shown_quality(const Pixels& original, const Pixels& shown, std::span<const std::uint8_t> known,
                           std::array<bool, 2> repeats = {});

/// Whether an image is at least as good as a limit. NaN is not.
bool is_within(const ImageQuality& shown, const ImageQuality& least);

/// Whether halved() takes an image.
bool can_be_halved(const Pixels& pixels);

/// Averages blocks of 2 x 2 texels. \pre the sides are even
Pixels halved(const Pixels& pixels);

/// Encodes an image in few bytes, so that shown_quality() of the decoded result is within `limits.quality`.
/// The resolution is halved as long as this alone is within the limit. At the least resolution and at
/// twice that, PNG and the JPEG or WebP of least sufficient quality are tried (with alpha: a PNG whose colours
/// differ by up to 6 of 255), and the result with the fewest bytes is taken; of two that differ by less than 10%,
/// that with fewer texels. A lossy WebP of low quality is taken without these, and lossless encodings are tried beside WebP
/// only where a sample says that they may be smaller.
/// \param pixels   at least one texel
/// \param known    by texel: nonzero if the texel shows a triangle
/// \param name     Image::name of the result
/// \param content  data is encoded with full chroma resolution
/// \param context  checked before each encoding; its exceptions are passed on
/// \return an image whose sides are those of `pixels`, divided by the same power of two
/// Complexity: that of about ten encodings.
Image encode_smallest(const Pixels& pixels, std::span<const std::uint8_t> known, const std::string& name,
                      Content content, const ImageLimits& limits, const RunContext& context = {});

}  // namespace faqem::detail
