#pragma once
/// \file
/// Ways to encode an image, among which a byte limit chooses.

#include <cstdint>
#include <vector>

#include "bake/texture/pending_images.hpp"
#include "faqem/asset.hpp"
#include "faqem/options.hpp"

namespace faqem::detail {

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
