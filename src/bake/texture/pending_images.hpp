#pragma once
/// \file
/// Images of a result before they are encoded, and ways to encode them, among which a byte limit chooses. They can be
/// encoded several times, with different limits.

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "asset/scene/material_textures.hpp"
#include "bake/texture/image_choice.hpp"
#include "faqem/asset.hpp"
#include "faqem/bake.hpp"
#include "faqem/detail/base/parallel.hpp"
#include "faqem/options.hpp"

namespace faqem::detail {

/// An image that is not encoded yet.
struct PendingImage {
    Index image = no_index;  ///< index into Asset::images of the result
    Pixels pixels;
    /// By texel: nonzero if it shows a triangle. Several images of a page share it.
    std::shared_ptr<const std::vector<std::uint8_t>> known;
    std::string name;  ///< Image::name
    TextureContent content = TextureContent::color;
    double roughness = 1;              ///< mean of the surface, in [0, 1]; for normals
    bool may_shrink = true;            ///< whether ImageFormat::automatic may choose a lower resolution
    bool was_jpeg = false;             ///< whether ImageFormat::source means JPEG
    bool is_new_map = false;           ///< a normal map of a material without one in the source
    bool tries_webp = false;           ///< whether ImageFormat::automatic tries WebP
    std::array<bool, 2> repeats = {};  ///< see shown_quality()
    /// The image of the source, if the pixels are its own: ImageFormat::automatic takes it if it is not larger,
    /// ImageFormat::source in any case.
    std::optional<Image> original = {};
    /// What the PSNR of the image may be more or less than usual if BakeOptions::image_quality is unset, in dB: see
    /// quality_change().
    double quality_change = 0;
};

/// A result of bake() before its images are encoded.
struct UnencodedResult {
    SimplifiedAsset asset;  ///< its pending images are empty until encode_images()
    std::vector<PendingImage> pending;
    /// Texels of new pages that show a triangle, and those of them without any point of the source.
    std::uint64_t shown_texels = 0, missing_texels = 0;
};

/// PendingImage::tries_webp for the images of a result: glTF needs an extension for WebP, which the source has then.
bool tries_webp(const Asset& source);

/// Halves the sides of an image, which is not that of the source any more. A texel is known if one of its four is.
/// \pre can_be_halved(image.pixels)
void halve(PendingImage& image);

/// Encodes images as BakeOptions::image_format says.
/// \param images  Asset::images of the result; receives the encoded images
/// \throws engine::Cancelled
/// Complexity: at most about ten encodings of each image.
void encode_pending_images(std::span<const PendingImage> pending, const BakeOptions& bake,
                           const RunContext& context, std::vector<Image>& images);

/// Difference in ImageEncoding::fineness that is visible.
inline constexpr std::uint32_t fineness_step = 8;

/// One way to encode an image.
struct ImageEncoding {
    enum class Codec {
        standard,  ///< what BakeOptions::image_format without has_image_quality() says
        original,  ///< the image of the source, PendingImage::original
        jpeg,
        png,
        webp,
        near_lossless_webp,
        lossless_webp,
    };
    Codec codec = Codec::standard;
    /// jpeg: JpegRounding::step. png: the largest difference of values. webp: the quality.
    std::uint32_t level = 0;
    /// From 0 for few bytes: encodings of different codecs with the same fineness lose about as much for a byte.
    /// Multiples of fineness_step differ visibly, the others are between.
    std::uint32_t fineness = 0;
};

/// The encodings that the options allow for an image, at least one, by ascending fineness.
/// \param pending  its pixels are not used beyond their size and the number of their colours
/// Complexity: O(texels).
std::vector<ImageEncoding> image_encodings(const PendingImage& pending, const BakeOptions& bake);

/// An image with one of its image_encodings().
/// Complexity: that of one encoding.
Image encode_as(const PendingImage& pending, const BakeOptions& bake, const ImageEncoding& encoding);

/// Mean squared difference of the values of an encoded image and its pixels at the known texels, in [0, 1].
/// Complexity: that of decoding.
double mean_square_error(const PendingImage& pending, const Image& encoded);

}  // namespace faqem::detail
