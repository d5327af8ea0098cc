#pragma once
/// \file
/// Which face counts and images to try for a byte limit, from the bytes and errors of each apart.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "result/picture_meter.hpp"

namespace faqem::detail {

/// Geometry that was tried, with perfect images and exact vertices.
struct TriedFaces {
    std::uint64_t faces = 0;
    std::uint64_t bytes = 0;  ///< with the first rounding that was tried
    PictureDifference error;
};

/// Rounding of vertices that was tried, on all faces with perfect images.
struct TriedRounding {
    std::optional<std::uint32_t> position_bits;  ///< QuantizeOptions::position_bits
    std::uint64_t bytes = 0;                     ///< of the geometry
    PictureDifference error;
};

/// An encoding of one image that was tried.
struct TriedImage {
    std::uint64_t bytes = 0;
    PictureDifference error;  ///< that it adds
    std::uint32_t side = 0;   ///< the longer one, texels
};

/// By image: the encodings that were tried.
using TriedImages = std::vector<std::vector<TriedImage>>;

/// A face count, images and a rounding that should fit.
struct ResultChoice {
    std::vector<std::size_t> images;  ///< by image: index of its encoding
    std::uint64_t image_bytes = 0;
    std::size_t rounding = 0;  ///< index
    std::uint64_t faces = 0;
    double psnr = 0;  ///< expected, dB
};

/// The largest face count whose geometry has at most `bytes`, interpolated between those that were tried; nothing if
/// all have more. O(tried)
/// \param tried  at least one, in descending order of faces
std::optional<std::uint64_t> faces_within(std::span<const TriedFaces> tried, std::uint64_t bytes);

/// The error of a face count, interpolated. \param tried  as for faces_within() O(tried)
PictureDifference error_of_faces(std::span<const TriedFaces> tried, std::uint64_t faces);

/// Bytes of geometry with a rounding, as bytes with the first one, to which it is in proportion. O(1)
std::uint64_t as_first_rounding(std::span<const TriedRounding> roundings, std::size_t rounding,
                                std::uint64_t bytes);

/// For face counts from few to as many as fit, and each rounding, the images with the least error in the bytes that are
/// left: encodings are exchanged for larger ones where that lowers the expected error most for a byte (Shoham and
/// Gersho, "Efficient bit allocation for an arbitrary set of quantizers", 1988). The best choice comes first, equal
/// ones in the order of the roundings, with more faces first.
/// \param images     nothing, or at least one encoding of each
/// \param roundings  at least one, with bytes > 0
/// Complexity: O(100 roundings n log n) for n encodings.
std::vector<ResultChoice> result_choices(std::span<const TriedFaces> faces, const TriedImages& images,
                                         std::span<const TriedRounding> roundings, std::uint64_t bytes);

/// By image: the encoding with the fewest bytes and, of several, the least error.
/// \param images  as for result_choices()
std::vector<std::size_t> smallest_images(const TriedImages& images);

}  // namespace faqem::detail
