#pragma once
/// \file
/// Encoding and resolution of baked images, chosen by the measured loss.

#include <cstdint>
#include <span>
#include <string>

#include "asset/image/image.hpp"
#include "asset/scene/material_textures.hpp"
#include "faqem/asset.hpp"
#include "faqem/detail/base/parallel.hpp"
#include "faqem/options.hpp"

namespace faqem::detail {

/// How far encode_smallest() may go.
struct ImageLimits {
    double quality;          ///< least PSNR in dB
    bool may_shrink = true;  ///< whether the result may have fewer texels
    bool tries_core = true;  ///< whether PNG and JPEG are tried, which glTF has without extensions
    bool tries_webp = false;
};

/// Least PSNR of an image of ImageFormat::automatic, in dB: BakeOptions::image_quality, and 4 less for roughness and
/// other data, but not less than 30 if colours have more (docs/measurements/appearance.md, "Image formats"). Normals
/// are between, since their errors show in reflections.
/// \param roughness  of the surface, in [0, 1]; for normals
double least_psnr(const BakeOptions& bake, TextureContent content, double roughness);

/// Peak signal-to-noise ratios, in dB; infinity if nothing differs.
struct ImageLoss {
    double psnr;        ///< over all known texels
    double worst_psnr;  ///< least one of a block of 8 x 8 texels; unknown texels of the block count as equal
};

/// Loss of an image that is shown instead of another: the differences at the texels of the other image, where
/// the first is interpolated bilinearly. Differences of colour are weighted by alpha.
/// \param original  at least one texel
/// \param shown     its sides are those of `original`, divided by the same power of two
/// \param known     by texel of `original`: nonzero for those that count
/// Complexity: O(texels of `original`).
ImageLoss image_loss(const Pixels& original, const Pixels& shown, std::span<const std::uint8_t> known);

/// Whether a loss is acceptable: the PSNR is at least `quality`, and that of each block at least `quality` - 15,
/// so that errors are not concentrated where they would be seen, such as at the seams of charts.
bool is_within(const ImageLoss& loss, double quality);

/// Averages blocks of 2 x 2 texels. \pre the sides are even
Pixels halved(const Pixels& pixels);

/// Encodes an image in few bytes, so that image_loss() of the decoded result is within `limits.quality`.
/// The resolution is halved as long as this loss alone is within the limit. At the least resolution and at
/// twice that, PNG and the JPEG or WebP of least sufficient quality are tried (with alpha: a PNG whose colours
/// differ by up to 6 of 255), and the result with the fewest bytes is taken; of two that differ by less than 10%,
/// that with fewer texels.
/// \param pixels   at least one texel
/// \param known    by texel: nonzero if the texel shows a triangle
/// \param name     Image::name of the result
/// \param content  data is encoded with full chroma resolution
/// \param check_cancelled  called before each encoding; its exceptions are passed on
/// \return an image whose sides are those of `pixels`, divided by the same power of two
/// Complexity: that of about ten encodings.
Image encode_smallest(const Pixels& pixels, std::span<const std::uint8_t> known, const std::string& name,
                      Content content, const ImageLimits& limits, CancellationCheck check_cancelled = {});

}  // namespace faqem::detail
