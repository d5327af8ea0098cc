#pragma once
/// \file
/// Which face counts and images to try for a byte budget, from the bytes and errors of both apart.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "cli/budget/picture_error.hpp"

namespace faqem::cli {

/// Geometry that was tried, with perfect images and exact vertices.
struct TriedFaces {
    std::uint64_t faces = 0;
    std::uint64_t bytes = 0;  ///< with the first rounding that was tried
    PictureError error;
};

/// Rounding of vertices that was tried, on all faces with perfect images.
struct TriedRounding {
    std::optional<std::uint32_t> position_bits;  ///< QuantizeOptions::position_bits
    std::uint64_t bytes = 0;                     ///< of the geometry
    PictureError error;
};

/// Images that were tried, on all faces.
struct TriedImages {
    std::uint32_t side = 0;         ///< limit of the sides, texels
    std::optional<double> quality;  ///< BakeOptions::image_quality
    std::uint64_t bytes = 0;
    PictureError error;
};

/// A face count, images and a rounding that should fit.
struct BudgetChoice {
    std::size_t images = 0;    ///< index
    std::size_t rounding = 0;  ///< index
    std::uint64_t faces = 0;
    double psnr = 0;  ///< expected, dB
};

/// The largest face count whose geometry has at most `bytes`, interpolated between those that were tried; nothing if
/// all have more. O(tried)
/// \param tried  at least one, in descending order of faces
std::optional<std::uint64_t> faces_within(std::span<const TriedFaces> tried, std::uint64_t bytes);

/// The error of a face count, interpolated. \param tried  as for faces_within() O(tried)
PictureError error_of_faces(std::span<const TriedFaces> tried, std::uint64_t faces);

/// Bytes of geometry with a rounding, as bytes with the first one, to which it is in proportion. O(1)
std::uint64_t as_first_rounding(std::span<const TriedRounding> roundings, std::size_t rounding,
                                std::uint64_t bytes);

/// For each set of images that leaves bytes for faces, and each rounding, the face count that fits; the best first, equal
/// ones in the order of the images and roundings. O(n (faces + log n)) for n pairs
/// \param roundings  at least one, with bytes > 0
std::vector<BudgetChoice> budget_choices(std::span<const TriedFaces> faces,
                                         std::span<const TriedImages> images,
                                         std::span<const TriedRounding> roundings, std::uint64_t bytes);

}  // namespace faqem::cli
